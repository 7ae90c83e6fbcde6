#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include <halfsilver/error.h>
#include "apps/commands.h"
#include "apps/devices.h"
#include "apps/scene_input.h"
#include "apps/statistics.h"

namespace halfsilver {
namespace {

using Json = nlohmann::ordered_json;

double luminance(const glm::vec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

// Reflectance at normal incidence from the factors alone, without textures.
double reflectivity(const Material& material) {
  if (material.mirror) return *material.mirror;
  if (material.unlit) return 0;
  const double ratio = (material.ior - 1.0) / (material.ior + 1.0);
  const double dielectric = std::min(1.0, ratio * ratio * luminance(material.specularColor)) * material.specular;
  return dielectric + (luminance(glm::vec3(material.baseColor)) - dielectric) * material.metallic;
}

const char* alphaModeName(AlphaMode mode) {
  return mode == AlphaMode::opaque ? "opaque" : mode == AlphaMode::mask ? "mask" : "blend";
}

const char* lightTypeName(LightType type) {
  switch (type) {
    case LightType::directional:
      return "directional";
    case LightType::point:
      return "point";
    case LightType::spot:
      return "spot";
    case LightType::rectangle:
      return "rectangle";
    case LightType::sphere:
      break;
  }
  return "sphere";
}

// The shortest decimal that reads back as the same float: 0.9, not 0.8999999761581421.
double shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), static_cast<float>(value)).ptr;
  double decimal = 0;
  std::from_chars(text, end, decimal);
  return decimal;
}

Json vectorJson(const glm::vec3& v) { return Json::array({shortest(v.x), shortest(v.y), shortest(v.z)}); }

// World coordinates of a point relative to the scene's origin.
Json worldJson(const Scene& scene, const glm::vec3& p) {
  return Json::array({scene.origin.x + shortest(p.x), scene.origin.y + shortest(p.y), scene.origin.z + shortest(p.z)});
}

Json lightJson(const Scene& scene, const Light& light) {
  Json json = {{"type", lightTypeName(light.type)},
               {"position", worldJson(scene, light.position)},
               {"direction", vectorJson(light.direction)},
               {"color", vectorJson(light.color)},
               {"intensity", shortest(light.intensity)}};
  if (light.type == LightType::sphere) json["radius"] = shortest(light.radius);
  if (light.type == LightType::rectangle) {
    json["up"] = vectorJson(light.up);
    json["width"] = shortest(light.width);
    json["height"] = shortest(light.height);
  }
  return json;
}

Json partsJson(const Model& model) {
  Json parts = Json::array();
  for (const Part& part : model.parts)
    parts.push_back({{"node", part.node},
                     {"mesh", part.mesh},
                     {"primitive", part.primitive},
                     {"first_triangle", part.firstTriangle},
                     {"triangles", part.triangleCount},
                     {"material", part.material}});
  return parts;
}

Json infoJson(const std::string& file, const Model& model) {
  const Scene& scene = model.scene;
  const Bounds bounds = scene.bounds();
  Json json;
  json["file"] = file;
  json["triangles"] = scene.triangles.size();
  json["vertices"] = scene.vertices.size();
  json["materials"] = Json::array();
  for (const Material& material : scene.materials)
    json["materials"].push_back({{"name", material.name},
                                 {"reflectivity", shortest(reflectivity(material))},
                                 {"roughness", shortest(material.mirror ? 0.0f : material.roughness)},
                                 {"metallic", shortest(material.metallic)},
                                 {"alpha_mode", alphaModeName(material.alphaMode)},
                                 {"double_sided", material.doubleSided},
                                 {"unlit", material.unlit}});
  json["textures"] = Json::array();
  for (const auto& texture : scene.textures)
    json["textures"].push_back({{"name", texture->name}, {"width", texture->width}, {"height", texture->height}});
  json["lights"] = Json::array();
  for (const Light& light : scene.lights) json["lights"].push_back(lightJson(scene, light));
  json["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras)
    json["cameras"].push_back({{"name", camera.name},
                               {"eye", worldJson(scene, camera.eye)},
                               {"target", worldJson(scene, camera.target)},
                               {"fov", shortest(glm::degrees(camera.verticalFov))},
                               {"parallel_height", shortest(camera.parallelHeight)}});
  json["bounds"] = nullptr;
  if (!bounds.empty())
    json["bounds"] = {{"low", worldJson(scene, bounds.low)}, {"high", worldJson(scene, bounds.high)}};
  json["diagonal"] = bounds.diagonal();
  json["dropped"] = {{"degenerate", model.dropped.degenerate}, {"non_finite", model.dropped.nonFinite}};
  json["animations"] = Json::array();
  for (const Animation& animation : model.rig.animations)
    json["animations"].push_back({{"name", animation.name},
                                  {"duration", shortest(animation.duration)},
                                  {"channels", animation.channels.size()}});
  json["variants"] = model.variants;
  json["parts"] = partsJson(model);
  json["warnings"] = model.warnings;
  return json;
}

void printMaterials(const Json& materials) {
  std::size_t width = 8;
  for (const Json& material : materials) width = std::max(width, material["name"].get<std::string>().size());
  for (const Json& material : materials) {
    const auto name = material["name"].get<std::string>();
    std::cout << "  " << name << std::string(width + 2 - name.size(), ' ') << "reflectivity "
              << material["reflectivity"] << ", roughness " << material["roughness"] << ", "
              << material["alpha_mode"].get<std::string>() << (material["double_sided"] ? ", double-sided" : "")
              << (material["unlit"] ? ", unlit" : "") << '\n';
  }
}

void printInfo(const Json& json) {
  std::cout << json["file"].get<std::string>() << "\n"
            << "triangles   " << json["triangles"] << " (dropped: " << json["dropped"]["degenerate"] << " degenerate, "
            << json["dropped"]["non_finite"] << " not finite)\n"
            << "vertices    " << json["vertices"] << "\n"
            << "textures    " << json["textures"].size() << "\n"
            << "lights      " << json["lights"].size() << "\n"
            << "bounds      ";
  if (json["bounds"].is_null())
    std::cout << "none\n";
  else
    std::cout << json["bounds"]["low"] << " to " << json["bounds"]["high"] << ", diagonal " << json["diagonal"]
              << " m\n";
  std::cout << "cameras     " << json["cameras"].size() << "\n";
  for (const Json& camera : json["cameras"])
    std::cout << "  " << camera["name"].get<std::string>() << "  eye " << camera["eye"] << " target "
              << camera["target"] << " fov " << camera["fov"] << "\n";
  std::cout << "animations  " << json["animations"].size() << "\n";
  for (std::size_t a = 0; a < json["animations"].size(); ++a) {
    const Json& animation = json["animations"][a];
    std::cout << "  " << a << " '" << animation["name"].get<std::string>() << "'  " << animation["duration"] << " s, "
              << animation["channels"] << " channels\n";
  }
  if (!json["variants"].empty()) std::cout << "variants    " << json["variants"].size() << "\n";
  for (std::size_t v = 0; v < json["variants"].size(); ++v)
    std::cout << "  " << v << " '" << json["variants"][v].get<std::string>() << "'\n";
  std::cout << "parts       " << json["parts"].size() << " (see --json)\n";
  std::cout << "materials   " << json["materials"].size() << "\n";
  printMaterials(json["materials"]);
}

}  // namespace

void addInfoCommand(CLI::App& program) {
  struct Request {
    std::string scene, variant;
    std::vector<std::string> lights;
    bool json = false, device = false;
  };
  CLI::App* command = program.add_subcommand("info", "Show what a scene contains, or what the devices offer");
  const auto request = std::make_shared<Request>();
  command->add_option("SCENE", request->scene, kSceneHelp);
  command->add_flag("--device", request->device, "Show the devices instead, what each offers and what is needed");
  command->add_option("--variant", request->variant, kVariantHelp);
  command->add_option("--light", request->lights, kLightHelp)->allow_extra_args(false);
  command->add_flag("--json", request->json,
                    "Print JSON, including every part (node and primitive) with its triangles");
  command->callback([request] {
    if (request->device) {
      if (!request->scene.empty()) throw Error(ErrorKind::usage, "info --device takes no SCENE");
      showDevices(request->json);
      return;
    }
    if (request->scene.empty()) throw Error(ErrorKind::usage, "SCENE is required");
    std::vector<LightArgument> lights;
    for (const std::string& text : request->lights) lights.push_back(parseLight(text));
    Model model = loadScene(request->scene, request->variant);
    addLights(model, lights);
    const Json json = infoJson(request->scene, model);
    if (request->json) {
      std::cout << dump(json);
      return;
    }
    for (const std::string& warning : model.warnings) std::cerr << "warning: " << warning << '\n';
    printInfo(json);
  });
}

}  // namespace halfsilver
