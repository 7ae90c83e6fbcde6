#include "bench/modes/mode.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <utility>

#include <halfsilver/error.h>
#include "bench/harness/points.h"
#include "bench/report/page.h"

namespace halfsilver::bench {
namespace {

struct Command {
  Request request;
  RequestTexts texts;
  std::vector<Mode> modes;
};

// Adds one command that runs the modes.
void addCommand(CLI::App& program, const std::string& name, const std::string& description, std::vector<Mode> modes) {
  CLI::App* command = program.add_subcommand(name, description);
  const auto shared = std::make_shared<Command>();
  shared->modes = std::move(modes);
  const auto any = [&](bool Mode::*has) {
    return std::any_of(shared->modes.begin(), shared->modes.end(), [&](const Mode& mode) { return mode.*has; });
  };
  Request& request = shared->request;
  addRequestOptions(*command, request, shared->texts);
  if (any(&Mode::takesReplay))
    addReplayOptions(*command, request);
  else if (any(&Mode::takesPaper))
    addPaperOptions(*command, request);
  else if (shared->modes.size() == 1 && any(&Mode::bringsOwnScenes))
    command->get_option("SCENE")->required(false);
  if (any(&Mode::takesPresets))
    command->add_option("--preset", request.presets, "A preset to measure; repeatable (see: halfsilver presets)")
        ->allow_extra_args(false);
  if (any(&Mode::takesMethods))
    command->add_option("--method", request.methods, "A method that stability measures; repeatable (default: all)")
        ->allow_extra_args(false);
  if (any(&Mode::takesTimeLimit))
    command
        ->add_option("--time-limit", request.timeLimit,
                     "Seconds per point of scaling; after a point that took longer, larger ones are skipped")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
  command->callback([shared] {
    checkRequest(shared->request, shared->texts);
    runModes(shared->request, shared->modes);
  });
}

// The request for modes that bring their own scenes: without what belongs to the scenes of the command.
Request withoutScenes(Request request) {
  request.scenes.clear();
  request.mirrors.clear();
  request.views.clear();
  request.camera = {};
  return request;
}

std::string contents(std::span<const Report> reports, std::span<const Mode> modes) {
  std::string html = "<nav>\n<ol>\n";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    html += "<li><a href=\"#" + modes[i].name;
    html += "\">" + escapeHtml(reports[i].title);
    html += "</a><br>" + escapeHtml(modes[i].description);
    html += "</li>\n";
  }
  return html + "</ol>\n</nav>\n";
}

std::string pageOf(std::span<const Report> reports, std::span<const Mode> modes, const std::string& device,
                   const std::vector<std::string>& excluded) {
  std::string body = introduction() + paragraph(device);
  if (reports.size() == 1) return page("Halfsilver: " + reports[0].title, body + reports[0].body);
  body += contents(reports, modes);
  if (!excluded.empty()) body += paragraph("Not measured:") + bullets(excluded);
  for (std::size_t i = 0; i < reports.size(); ++i) body += article(modes[i].name, reports[i].title, reports[i].body);
  return page("Halfsilver: methods for ray-traced reflections, measured", body);
}

void print(std::span<const Report> reports, std::span<const Mode> modes) {
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (reports.size() > 1) std::cout << (i > 0 ? "\n" : "") << modes[i].name << '\n';
    std::cout << toText(reports[i].summary);
    for (const std::string& warning : reports[i].warnings) std::cerr << "warning: " << warning << '\n';
  }
}

}  // namespace

void runModes(const Request& request, std::span<const Mode> modes) {
  std::vector<BenchScene> scenes = loadScenes(request), none;
  Workbench bench(request);
  const OutputFolder folder(request.folder);
  const Request ownScenes = withoutScenes(request);

  std::vector<Mode> planned;
  std::vector<Plan> plans;
  std::vector<Batch> batches;
  std::vector<std::string> excluded;
  for (const Mode& mode : modes) {
    const bool own = modes.size() > 1 && mode.bringsOwnScenes;
    try {
      plans.push_back(mode.plan({own ? ownScenes : request, own ? none : scenes, bench, folder}));
    } catch (const Error& error) {
      if (modes.size() == 1 || error.kind() != ErrorKind::failed) throw;
      excluded.push_back(mode.name + ": " + error.what());
      std::cerr << "warning: not measured: " << excluded.back() << '\n';
      continue;
    }
    planned.push_back(mode);
    batches.push_back({mode.name, Points(folder / (mode.name + ".json"), mode.name), std::move(plans.back().tasks)});
  }

  const std::vector<MeasuredPoints> points = measureAll(batches);
  std::vector<Report> reports;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    reports.push_back(plans[i].report(points[i]));
    reports.back().name = planned[i].name;
  }
  writeReports(folder.path(), reports, pageOf(reports, planned, plans.front().measuredWith, excluded));
  print(reports, planned);
}

void addModes(CLI::App& program, const std::vector<Mode>& modes) {
  for (const Mode& mode : modes) addCommand(program, mode.name, mode.description, {mode});
  std::vector<Mode> ofScenes;
  std::copy_if(modes.begin(), modes.end(), std::back_inserter(ofScenes),
               [](const Mode& mode) { return !mode.takesReplay && !mode.takesPaper; });
  addCommand(program, "all", "All that measure scenes in turn, on one page", ofScenes);
}

}  // namespace halfsilver::bench
