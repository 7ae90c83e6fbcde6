#pragma once

#include "gltf_files.h"

// One file that holds something of everything that the loader reads.
namespace halfsilver::testing {

// Everything that the loader reads: indices, sparse, skin, morph targets, animations, cameras, lights, textures.
inline GltfFile everything() {
  GltfFile file;
  const int positions = file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  const int sparseIndices = file.view(std::vector<std::uint16_t>{1, 3});
  const int sparseValues = file.view(std::vector<float>{1, 0, 1, 0, 1, 1});
  file.root["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", sparseIndices}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", sparseValues}}}};
  json& primitive = file.primitive(
      {{"POSITION", positions},
       {"TEXCOORD_0", file.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")},
       {"NORMAL", file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
       {"COLOR_0", file.accessor(std::vector<std::uint8_t>(16, 200), "VEC4", true)},
       {"JOINTS_0", file.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC4")},
       {"WEIGHTS_0", file.accessor(std::vector<float>(16, 0.25f), "VEC4")}});
  primitive["indices"] = file.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR");
  primitive["material"] = 0;
  primitive["targets"] = {{{"POSITION", file.accessor(std::vector<float>(12, 0.1f), "VEC3")}}};
  file.root["meshes"][0]["weights"] = {0.5};
  file.root["nodes"][0]["skin"] = 0;
  file.add("nodes", {{"children", {2, 3}}, {"rotation", {0, 0, 0, 1}}});
  file.add("nodes", {{"translation", {0, 1, 0}}, {"children", {4}}});
  file.add("nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.add("nodes", {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}});
  file.add("skins",
           {{"joints", {1, 2}},
            {"inverseBindMatrices", file.accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,  //
                                                                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                                  "MAT4")}});
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  file.add("animations", {{"samplers",
                           {{{"input", times}, {"output", file.accessor(std::vector<float>{0, 0, 0, 0, 2, 0}, "VEC3")}},
                            {{"input", times}, {"output", file.accessor(std::vector<float>{0, 1}, "SCALAR")}}}},
                          {"channels",
                           {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}},
                            {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  file.add("images", {{"bufferView", file.view(smallPng())}, {"mimeType", "image/png"}});
  file.add("samplers", {{"wrapS", 33071}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  file.add("materials",
           {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"normalTexture", {{"index", 0}}}});
  file.root["scenes"] = {{{"nodes", {0, 1}}}};
  file.root["scene"] = 0;
  return file;
}

}  // namespace halfsilver::testing
