#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include <halfsilver/scene.h>
#include <halfsilver/shared_structs.h>

namespace halfsilver {

// What all rays of a call share.
struct RayQuery {
  float minDistance = 0;  // nearer hits are ignored, meters
  bool cullBackFaces = true;
  bool any = false;  // any hit will do
};

// The scene's triangles in Embree's hierarchy, which refers to the scene's own arrays.
class EmbreeScene {
 public:
  EmbreeScene(const Scene& scene, unsigned threads);  // of builds

  enum class Quality { fastTrace, fastBuild };
  // Throws Error (failed).
  void build(Quality quality);
  bool ready() const { return scene_ != nullptr; }  // the last build succeeded
  std::uint64_t bytes() const { return static_cast<std::uint64_t>(std::max<std::int64_t>(0, bytes_.load())); }

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
  void traceOne(const shared::Ray& ray, const RayQuery& query, shared::Hit& hit) const;
  void tracePacket(const shared::Ray* rays, const RayQuery& query, shared::Hit* hits) const;

  const Scene* source_;
  std::atomic<std::int64_t> bytes_{0};
  std::unique_ptr<RTCDeviceTy, DeviceRelease> device_;
  std::unique_ptr<RTCSceneTy, SceneRelease> scene_;
  bool packets_ = false;  // this processor has vectors for them
};

}  // namespace halfsilver
