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
    const std::string text = !value.is_null() ? value.dump() : name == "psnr_db" ? "inf" : "not available";
    std::cout << name << std::string(20 - name.size(), ' ') << text << '\n';
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
  command->add_option("REFERENCE", request->reference, "What it should be: the second file is the truth")->required();
  command->add_flag("--json", request->json, "Print JSON; psnr_db is null where the files are equal");
  command->add_option("--diagonal", request->diagonal, "Scene diagonal in metres, for layer files that do not say it")
      ->check(CLI::PositiveNumber);
  command->footer(
      "rmse, psnr_db and max_error are over R, G and B in the files' own values (PNG: display values 0..1; EXR: linear "
      "radiance).\nThe Yee figures are OpenImageIO's perceptual comparison. Where both are layer files, hit_error and "
      "the "
      "figures after it are shares of the pixels\nselected in either file: false_miss is a hit in REFERENCE only, "
      "false_hit a hit in IMAGE only.");
  command->callback([request] { compare(*request); });
}

}  // namespace halfsilver
