#include <optional>
#include <utility>

#include "bench/modes/pareto/report.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

// "1.25 (1.19 to 1.31)"
std::string spreadText(const Spread& spread, int digits) {
  std::string text = number(spread.median, digits);
  text += " (";
  text += number(spread.min, digits);
  text += " to ";
  text += number(spread.max, digits);
  return text + ')';
}

std::string verdict(const ParetoScene& scene, Accuracy accuracy) {
  std::string text = scene.name;
  text += ", time against ";
  text += accuracyName(accuracy, {&scene, 1});
  text += ": ";
  const std::optional<std::size_t> at = defaultOf(scene);
  if (!at) return text + "the default was not measured.";
  if (!competes(scene.variants[*at], accuracy)) return text + "nothing reflects here.";
  const ParetoVariant& own = scene.variants[*at];
  if (const auto other = beatenBy(scene, *at, accuracy)) {
    const ParetoVariant& better = scene.variants[*other];
    text += "the default is not on the front. ";
    text += better.name;
    text += " takes ";
    text += spreadText(pairedRatio(better, own), 2);
    text += " times as long and is ";
    text += *errorOf(better, accuracy) < *errorOf(own, accuracy) ? "more accurate." : "as accurate.";
    return text;
  }
  text += "the default is on the front of the GPU methods";
  if (!onFront(scene, *at, accuracy)) text += ", within the noise";
  return text + ": nothing that is as accurate was faster in every round and by " + percent(kParetoNoise, 0) +
         " or more.";
}

Table variantTable(const ParetoScene& scene) {
  Table table{{"Variant", "Frame, ms", "Times the default, same round", "Rounds", "Structure, MB", "Rays traced",
               "Wrong hits", "Perceptible pixels", "RMSE", "By hits", "By picture"},
              {}};
  const std::optional<std::size_t> own = defaultOf(scene);
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const ParetoVariant& variant = scene.variants[i];
    table.rows.push_back({variant.name, spreadText(frameTime(variant), 1),
                          own ? spreadText(pairedRatio(variant, scene.variants[*own]), 2) : "",
                          std::to_string(variant.frames.size()), megabytes(variant.bytes()),
                          percent(variant.errors.share), optionalPercent(variant.errors.hitError),
                          optionalPercent(variant.errors.perceptible), number(variant.errors.rmse, 5),
                          standing(scene, i, Accuracy::hits), standing(scene, i, Accuracy::picture)});
  }
  return table;
}

// What another bounce costs and brings, against the reference with the most bounces.
Table bounceTable(ParetoScenes scenes) {
  Table table{{"Scene", "Bounces", "Frame, ms", "Times one bounce", "Perceptible pixels", "RMSE"}, {}};
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    for (const ParetoVariant& variant : scene.variants) {
      const std::optional<PictureErrors>& errors = variant.first.errorsOfBounces;
      if (!own || !errors) continue;
      table.rows.push_back({scene.name, std::to_string(variant.first.settings.trace.bounces),
                            spreadText(frameTime(variant), 1),
                            spreadText(pairedRatio(variant, scene.variants[*own]), 2),
                            optionalPercent(errors->perceptible), number(errors->rmse, 5)});
    }
  }
  return table;
}

constexpr const char* kIntroduction =
    "<p>This part sets the time of a frame against its accuracy: every method and preset with a range of settings, "
    "and the default among them. No filled mark is both further left and further down than the <em>front</em>: no "
    "other variant beats one on the front in time and accuracy at once.</p>\n";

constexpr const char* kCaption =
    "Both axes are logarithmic; a row below the axis, set off by the dotted line, holds the marks whose error is "
    "exactly 0. The radius of a mark grows by the same amount for each tenfold memory of the structure. Filled marks "
    "compete, hollow ones stand beside the comparison. The line is the front of the medians. Labeled are the default, "
    "the front, what stands beside and what traces fewer rays, if there is room; all names are in the tables.";

std::string methodNotes() {
  std::string rounds =
      "A round draws every variant of a scene once, in turn, each after a frame that is not counted: a slow moment of "
      "the machine does not affect only one of them. Times are medians of the rounds, from the fastest to the slowest; "
      "multiples of the default are taken within each round. There are up to five rounds (two in a quick run), as many "
      "as fit into ";
  rounds += number(kParetoSeconds, 0);
  rounds += " s of measured frames per variant, but at least two.";
  std::string behind = "A variant is behind another if that has no more error and was faster in every round and by ";
  behind += percent(kParetoNoise, 0);
  behind += " or more; \"within the noise\" means that only the medians put it behind.";
  return bullets(
      {"Frame: the GPU's time for the whole picture without shadow maps, which are kept while lights and scene stay "
       "the same. All structures are rebuilt in every frame, as for a moving scene; \"kept\" shows a frame of the "
       "default if nothing moved.",
       rounds,
       "Wrong hits: of the rays that the variant and the reference both traced, the share that hits although the "
       "reference misses, misses although it hits, or hits more than 0.1 % of the scene's diagonal away from it. A "
       "pixel that was not traced is not a wrong hit but an error of the picture: variants that trace fewer rays than "
       "the reference are not in the charts and on the front of the hits. Variants that trace more (hu2014: all "
       "pixels) are judged by the reference's rays alone. Hits are those of the first bounce.",
       "Pictures are compared with the reference's, with every reflective pixel traced. Perceptible pixels: the share "
       "that fails the comparison of Yee et al. 2001 on linear radiance; RMSE: root mean square difference of the "
       "display values, 0 to 1.",
       "More bounces make another picture: such variants are compared with the reference of as many bounces and stand "
       "beside the others. What the bounces bring is shown further down.",
       behind});
}

}  // namespace

std::vector<std::string> paretoVerdicts(const ParetoScene& scene) {
  std::vector<std::string> texts;
  for (const Accuracy accuracy : kAccuracies) texts.push_back(verdict(scene, accuracy));
  return texts;
}

std::string paretoBody(ParetoScenes scenes, const std::vector<Figure>& pictures,
                       const std::optional<std::string>& svg) {
  std::vector<std::string> verdicts;
  for (const ParetoScene& scene : scenes)
    for (std::string& text : paretoVerdicts(scene)) verdicts.push_back(std::move(text));
  std::string body = kIntroduction + gallery(pictures);
  body += heading("Where the default stands") + bullets(verdicts);
  body += heading("Time against accuracy") + chartFigure(svg, kCaption) + methodNotes();
  for (const ParetoScene& scene : scenes) body += heading(scene.name) + toHtml(variantTable(scene));
  body += heading("What more bounces bring") +
          paragraph("Against the reference with four bounces: what is still missing in the picture.") +
          toHtml(bounceTable(scenes));
  return body;
}

}  // namespace halfsilver::bench
