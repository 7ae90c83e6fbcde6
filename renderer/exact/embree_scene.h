#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <halfsilver/model.h>
#include <halfsilver/scene.h>
#include <halfsilver/shared_structs.h>

namespace halfsilver {

// What all rays of a call share.
struct RayQuery {
  float minDistance = 0;  // FrameConstants::minDistance
  bool cullBackFaces = true;
  bool any = false;     // any hit will do
  bool blends = false;  // FrameConstants::blends
};

// The triangles of the source that Embree's geometries hold, by the numbers that it gives them.
struct EmbreeParts {
  static constexpr unsigned kStill = 0, kMoving = 1;  // names of the geometries

  std::vector<std::uint32_t> still;  // empty: all of the source
  std::vector<std::uint32_t> moving;
  std::vector<bool> moves;  // by triangle of the source

  std::uint32_t number(unsigned geometry, unsigned primitive) const {
    if (geometry == kMoving) return moving[primitive];
    return still.empty() ? primitive : still[primitive];
  }
};

// The scene's triangles in Embree's hierarchy. What has never moved since build() is one geometry, with a hierarchy
// that is made to trace fast; what has is another, with one that is made fast. Embree joins the two by their upper
// nodes, so that a ray has one way to go.
class EmbreeScene {
 public:
  EmbreeScene(const Scene& scene, unsigned threads);  // of builds

  // Another scene, for the next build.
  void use(const Scene& scene) { source_ = &scene; }

  // Both throw Error (failed).
  void build();
  void follow(std::span<const VertexRange> moved);  // and triangles that turned with them
  bool ready() const { return scene_ != nullptr; }  // the last build succeeded
  std::uint64_t bytes() const;

  // Writes a hit for each ray. Neighbors that go the same way are traced together, which changes no bit of a hit: the
  // nearest triangle wins, and of several at one distance the one with the lowest number. Any number of threads may.
  void trace(std::span<const shared::Ray> rays, const RayQuery& query, std::span<shared::Hit> hits) const;

 private:
  struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  struct GeometryRelease {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
  };
  using Geometry = std::unique_ptr<RTCGeometryTy, GeometryRelease>;

  Geometry makeGeometry(RTCBuildQuality quality) const;
  void makeStill();
  bool noteMoves(std::span<const VertexRange> moved);
  void setIndices(const Geometry& geometry, std::span<const std::uint32_t> numbers,
                  std::vector<std::uint32_t>& indices) const;
  void commit();
  void traceOne(const shared::Ray& ray, const RayQuery& query, shared::Hit& hit) const;
  void tracePacket(const shared::Ray* rays, const RayQuery& query, shared::Hit* hits) const;

  const Scene* source_;
  std::atomic<std::int64_t> bytes_{0};
  std::unique_ptr<RTCDeviceTy, DeviceRelease> device_;
  std::unique_ptr<RTCSceneTy, SceneRelease> scene_;
  Geometry moving_;
  EmbreeParts parts_;
  std::vector<bool> movedVertices_;
  std::vector<std::uint32_t> stillIndices_, movingIndices_;  // which Embree reads in place
  std::size_t ghosts_ = 0;  // triangles of the still geometry that have moved since it was made
  bool packets_ = false;    // this processor has vectors for them
};

}  // namespace halfsilver
