#include <halfsilver/io.h>

#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "apps/commands.h"
#include "apps/statistics.h"

namespace halfsilver {
namespace {

struct CompareRequest {
  std::string image, reference;
  std::optional<double> diagonal;
  bool json = false;
};

void printComparison(const Comparison& comparison) {
  const nlohmann::ordered_json json = toJson(comparison);
  for (const auto& [name, value] : json.items()) {
    if (name == "kinds") continue;
    const std::string text = !value.is_null() ? value.dump() : name == "psnr_db" ? "inf" : "not available";
    std::cout << name << std::string(20 - name.size(), ' ') << text << '\n';
  }
  if (!json.contains("kinds")) return;
  for (const auto& [kind, figures] : json["kinds"].items()) {
    std::cout << "rays: " << kind;
    for (const auto& [name, value] : figures.items())
      std::cout << (name == "rays" ? std::string(14 - kind.size(), ' ') : ", " + name + ' ') << value.dump();
    std::cout << '\n';
  }
}

void compare(const CompareRequest& request) {
  const ImageFile image = readImage(request.image);
  const ImageFile reference = readImage(request.reference);
  const Comparison comparison = compareImages(image, reference, request.diagonal);
  if (request.json)
    std::cout << dump(toJson(comparison));
  else
    printComparison(comparison);
}

}  // namespace

void addCompareCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("compare", "Measure how far an image is from a reference");
  const auto request = std::make_shared<CompareRequest>();
  command->add_option("IMAGE", request->image, "The image to judge: PNG, EXR, ...")->required();
  command->add_option("REFERENCE", request->reference, "The image to compare it with, taken as correct")->required();
  command->add_flag("--json", request->json, "Print JSON; psnr_db is null if the images are equal");
  command
      ->add_option("--diagonal", request->diagonal,
                   "Diagonal of the scene in meters, if the layer files do not contain it")
      ->check(CLI::PositiveNumber);
  command->footer(
      "rmse, psnr_db and max_error compare R, G and B as stored (PNG: display values 0..1; EXR: linear radiance).\n"
      "yee_failures and yee_fail_fraction are OpenImageIO's perceptual comparison. If both are layer files, hit_error "
      "and\nthe figures after it are fractions of the pixels selected in either file: false_miss is a hit in REFERENCE "
      "only,\nfalse_hit a hit in IMAGE only. Files that were rendered with --set trace.tally=true also compare all "
      "rays of "
      "each kind,\nby counts: false_occlusion are hits in IMAGE beyond those of REFERENCE, pixel by pixel, "
      "false_visibility the other way\nround, unmatched rays that only one of them has sent.");
  command->callback([request] { compare(*request); });
}

}  // namespace halfsilver
