#include "bench/modes/common_text.h"

namespace halfsilver::bench {
namespace {

constexpr const char* kIntroduction = R"(<p>Halfsilver draws a picture by rasterization and traces rays only where a
surface reflects. To find what a ray hits without ray-tracing hardware, the triangles are rasterized once more, from
three sides, into a <em>structure</em> that rays can walk through: a coarse grid of voxels, and an <em>A-buffer</em>,
which keeps a list of surface fragments per texel. Methods differ in what a fragment is, where it is stored and how
rays search for it. A <em>preset</em> is a method with all its settings:</p>
<ul>
<li><b>halfsilver</b>: the default. A fragment is the number of its triangle (4 bytes), stored along one of three axes
and only for voxels that a ray asks for; the ray is tested against the triangle itself.</li>
<li><b>kastrati2017</b>: Kastrati &amp; Goswami 2017. A fragment holds the surface's attributes (32 bytes) and is stored
along the dominant axis of its voxel, in pages of four; rays compare depths.</li>
<li><b>hu2014</b>: Hu et al. 2014. The same fragments along all three axes, in sorted linked lists.</li>
<li><b>voxels</b>: what Hu et al. hold against their method. A grid alone, whose occupied voxels are what rays hit;
of as many voxels as the papers' methods have.</li>
<li><b>reference</b>: exact rays on the CPU (Embree). It traces the same rays, so a difference from it is an error of
the method.</li>
</ul>
)";

}  // namespace

std::string introduction() { return kIntroduction; }

std::string measuredWith(const std::string& version, const Device& device, const Size& size) {
  return "Measured with Halfsilver " + version + " on " + device.renderer + " (" + device.version + ", " +
         device.context + "), pictures of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
         " pixels. All sizes are in MB, 10^6 bytes.";
}

std::string sceneCaption(const SceneRecord& scene, const std::string& remark) {
  std::string caption = scene.file + ", " + std::to_string(scene.triangles) + " triangles" + remark;
  for (const std::string& mirror : scene.mirrors) caption += ", mirror " + mirror;
  return caption;
}

}  // namespace halfsilver::bench
