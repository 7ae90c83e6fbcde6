#include "io/gltf_animations.h"

#include <algorithm>
#include <cmath>

#include "io/gltf_accessors.h"

namespace halfsilver::gltf {
namespace {

void requireFinite(const std::vector<float>& values, const Diagnostics& diagnostics, const std::string& where) {
  for (const float value : values)
    if (!std::isfinite(value)) diagnostics.fail("has a value that is not finite", where);
}

std::size_t morphTargets(const Document& document, int fileNode) {
  const int mesh = document.nodes[static_cast<std::size_t>(fileNode)].mesh;
  if (mesh < 0) return 0;
  const auto& primitives = document.meshes[static_cast<std::size_t>(mesh)].primitives;
  return primitives.empty() ? 0 : primitives.front().targets.size();
}

class ChannelReader {
 public:
  ChannelReader(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy)
      : document_(document), diagnostics_(diagnostics), hierarchy_(hierarchy) {}

  // Nothing if the channel cannot be played.
  std::optional<halfsilver::Channel> read(const Animation& animation, const Channel& source, const std::string& where) {
    get(document_.nodes, source.node, "nodes", diagnostics_, where);
    const AnimationSampler& sampler = get(animation.samplers, source.sampler, "samplers", diagnostics_, where);
    halfsilver::Channel channel;
    channel.node = hierarchy_.rigNode[static_cast<std::size_t>(source.node)];
    std::size_t width = 3;
    if (source.path == "translation") {
      channel.property = AnimatedProperty::translation;
    } else if (source.path == "rotation") {
      channel.property = AnimatedProperty::rotation;
      width = 4;
    } else if (source.path == "scale") {
      channel.property = AnimatedProperty::scale;
    } else if (source.path == "weights") {
      channel.property = AnimatedProperty::weights;
      width = morphTargets(document_, source.node);
      if (width == 0) return leaveOut("weights of a node without morph targets are", where);
    } else {
      return leaveOut("the path \"" + source.path.substr(0, 40) + "\" is", where);
    }
    if (hierarchy_.nodes[static_cast<std::size_t>(channel.node)].hasMatrix && source.path != "weights")
      return leaveOut("a node with a matrix is", where);
    if (sampler.interpolation == "STEP")
      channel.interpolation = Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
      channel.interpolation = Interpolation::cubicSpline;
    else if (sampler.interpolation != "LINEAR")
      diagnostics_.warn("an unknown interpolation is treated as LINEAR: " + where);
    readKeys(sampler, width, channel, where);
    dropKeys(channel, width, where);
    if (channel.times.empty()) return leaveOut("without a key at or after 0 its target is", where);
    return channel;
  }

 private:
  std::optional<halfsilver::Channel> leaveOut(const std::string& what, const std::string& where) {
    diagnostics_.warn(what + " not animated: " + where);
    return std::nullopt;
  }

  void readKeys(const AnimationSampler& sampler, std::size_t width, halfsilver::Channel& channel,
                const std::string& where) {
    channel.times = readFloats(document_, diagnostics_, sampler.input, 1, 1, where + ".input").values;
    requireFinite(channel.times, diagnostics_, where + ".input");
    const bool isWeights = channel.property == AnimatedProperty::weights;
    const int components = isWeights ? 1 : static_cast<int>(width);
    channel.values =
        readFloats(document_, diagnostics_, sampler.output, components, components, where + ".output").values;
    requireFinite(channel.values, diagnostics_, where + ".output");
    const std::size_t keys = channel.times.size() * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
    if (channel.values.size() != keys * width)
      diagnostics_.fail("has " + std::to_string(channel.values.size()) + " numbers for " + std::to_string(keys) +
                            " keys of " + std::to_string(width),
                        where + ".output");
    if (channel.property == AnimatedProperty::rotation) requireDirections(channel, where);
  }

  // Keys must increase from 0: one that does not is left out, and what it says with it.
  void dropKeys(halfsilver::Channel& channel, std::size_t width, const std::string& where) {
    const std::size_t perKey = width * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
    std::size_t kept = 0;
    for (std::size_t key = 0; key < channel.times.size(); ++key) {
      if (channel.times[key] < 0 || (kept > 0 && channel.times[key] <= channel.times[kept - 1])) continue;
      channel.times[kept] = channel.times[key];
      std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>(key * perKey), perKey,
                  channel.values.begin() + static_cast<std::ptrdiff_t>(kept * perKey));
      ++kept;
    }
    if (kept == channel.times.size()) return;
    diagnostics_.warn(std::to_string(channel.times.size() - kept) +
                      " keys whose times do not increase from 0 were left out: " + where + ".input");
    channel.times.resize(kept);
    channel.values.resize(kept * perKey);
  }

  void requireDirections(const halfsilver::Channel& channel, const std::string& where) const {
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    for (std::size_t key = 0; key < channel.times.size(); ++key) {
      const float* q = channel.values.data() + 4 * (cubic ? 3 * key + 1 : key);
      if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
        diagnostics_.fail("has a rotation without a direction", where + ".output");
    }
  }

  const Document& document_;
  Diagnostics& diagnostics_;
  const Hierarchy& hierarchy_;
};

}  // namespace

void buildSkins(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Rig& rig) {
  for (std::size_t s = 0; s < document.skins.size(); ++s) {
    const Skin& source = document.skins[s];
    const std::string where = item("skins", s);
    halfsilver::Skin skin;
    for (const int joint : source.joints) {
      get(document.nodes, joint, "nodes", diagnostics, where + ".joints");
      skin.joints.push_back(hierarchy.rigNode[static_cast<std::size_t>(joint)]);
    }
    if (skin.joints.empty()) diagnostics.fail("has no joints", where);
    skin.inverseBind.assign(skin.joints.size(), glm::dmat4(1));
    if (source.inverseBind >= 0) {
      const Floats matrices =
          readFloats(document, diagnostics, source.inverseBind, 16, 16, where + ".inverseBindMatrices");
      requireFinite(matrices.values, diagnostics, where + ".inverseBindMatrices");
      if (matrices.count() < skin.joints.size()) diagnostics.fail("has fewer inverse bind matrices than joints", where);
      for (std::size_t j = 0; j < skin.joints.size(); ++j)
        for (int i = 0; i < 16; ++i)
          skin.inverseBind[j][i / 4][i % 4] =
              i % 4 == 3 ? (i == 15 ? 1.0 : 0.0)
                         : static_cast<double>(matrices.values[16 * j + static_cast<std::size_t>(i)]);
    }
    rig.skins.push_back(std::move(skin));
  }
}

void buildAnimations(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Rig& rig) {
  ChannelReader reader(document, diagnostics, hierarchy);
  for (std::size_t a = 0; a < document.animations.size(); ++a) {
    const Animation& source = document.animations[a];
    halfsilver::Animation animation;
    animation.name = source.name;
    for (std::size_t c = 0; c < source.channels.size(); ++c) {
      auto channel = reader.read(source, source.channels[c], item("animations", a) + "." + item("channels", c));
      if (!channel) continue;
      animation.duration = std::max(animation.duration, channel->times.back());
      animation.channels.push_back(std::move(*channel));
    }
    rig.animations.push_back(std::move(animation));
  }
}

std::vector<std::uint8_t> movingNodes(const Rig& rig) {
  std::vector<std::uint8_t> moving(rig.nodes.size(), 0);
  for (const auto& animation : rig.animations)
    for (const auto& channel : animation.channels)
      if (channel.property != AnimatedProperty::weights) moving[static_cast<std::size_t>(channel.node)] = 1;
  for (std::size_t n = 0; n < rig.nodes.size(); ++n)
    if (const int parent = rig.nodes[n].parent; parent >= 0 && moving[static_cast<std::size_t>(parent)]) moving[n] = 1;
  return moving;
}

bool canMove(const Rig& rig, const std::vector<std::uint8_t>& moving, const Instance& instance) {
  if (!instance.targets.empty())
    for (const auto& animation : rig.animations)
      for (const auto& channel : animation.channels)
        if (channel.node == instance.node && channel.property == AnimatedProperty::weights) return true;
  if (instance.skin < 0) return moving[static_cast<std::size_t>(instance.node)] != 0;
  const auto& joints = rig.skins[static_cast<std::size_t>(instance.skin)].joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](int joint) { return moving[static_cast<std::size_t>(joint)] != 0; });
}

}  // namespace halfsilver::gltf
