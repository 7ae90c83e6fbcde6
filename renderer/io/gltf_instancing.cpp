#include "io/gltf_accessors.h"
#include "io/gltf_decompress.h"

namespace halfsilver::gltf {
namespace {

class Instancing {
 public:
  Instancing(Document& document, Diagnostics& diagnostics) : document_(document), diagnostics_(diagnostics) {}

  void expand(std::size_t index) {
    const std::string where = item("nodes", index) + ".EXT_mesh_gpu_instancing";
    const std::map<std::string, int> attributes = document_.nodes[index].instancing;
    const Floats translations = read(attributes, "TRANSLATION", 3, where);
    const Floats rotations = read(attributes, "ROTATION", 4, where);
    const Floats scales = read(attributes, "SCALE", 3, where);
    std::size_t count = 0;
    for (const Floats* values : {&translations, &rotations, &scales}) {
      if (values->components == 0) continue;
      if (count != 0 && values->count() != count) diagnostics_.fail("has attributes of different lengths", where);
      count = values->count();
    }
    for (const auto& [name, accessor] : attributes)
      if (!name.starts_with("_") && name != "TRANSLATION" && name != "ROTATION" && name != "SCALE")
        diagnostics_.warn("instances' " + name.substr(0, 40) + " is ignored: " + where);
    if (count == 0) {
      diagnostics_.warn("instances without a known attribute are ignored: " + where);
      return;
    }
    constexpr std::size_t kNodeCost = 64;  // in elements of the budget
    diagnostics_.spend(count * kNodeCost, where);
    const Node carrier = document_.nodes[index];
    for (std::size_t i = 0; i < count; ++i) {
      Node node;
      node.name = (carrier.name.empty() ? "node " + std::to_string(index) : carrier.name) + " " + std::to_string(i);
      node.mesh = carrier.mesh;
      node.skin = carrier.skin;
      node.weights = carrier.weights;
      node.translation = value(translations, i);
      node.rotation = value(rotations, i);
      node.scale = value(scales, i);
      document_.nodes[index].children.push_back(static_cast<int>(document_.nodes.size()));
      document_.nodes.push_back(std::move(node));
    }
    document_.nodes[index].mesh = document_.nodes[index].skin = -1;
    document_.nodes[index].weights.clear();
    moveWeights(static_cast<int>(index), count);
  }

 private:
  Floats read(const std::map<std::string, int>& attributes, const char* name, int components,
              const std::string& where) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    return readFloats(document_, diagnostics_, found->second, components, components, where + "." + name);
  }

  static std::vector<double> value(const Floats& values, std::size_t index) {
    if (values.components == 0) return {};
    const auto first = values.values.begin() + static_cast<std::ptrdiff_t>(index) * values.components;
    return {first, first + values.components};
  }

  // What animates the morph weights of the node animates those of its instances, the last nodes.
  void moveWeights(int node, std::size_t count) {
    for (Animation& animation : document_.animations) {
      std::vector<Channel> channels;
      for (const Channel& channel : animation.channels) {
        if (channel.node != node || channel.path != "weights") {
          channels.push_back(channel);
          continue;
        }
        diagnostics_.spend(count, "animations");
        for (std::size_t i = document_.nodes.size() - count; i < document_.nodes.size(); ++i)
          channels.push_back({static_cast<int>(i), channel.sampler, channel.path});
      }
      animation.channels = std::move(channels);
    }
  }

  Document& document_;
  Diagnostics& diagnostics_;
};

}  // namespace

void expandInstances(Document& document, Diagnostics& diagnostics) {
  Instancing instancing(document, diagnostics);
  const std::size_t nodes = document.nodes.size();
  for (std::size_t n = 0; n < nodes; ++n)
    if (!document.nodes[n].instancing.empty() && document.nodes[n].mesh >= 0) instancing.expand(n);
}

}  // namespace halfsilver::gltf
