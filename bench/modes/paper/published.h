#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/settings.h>
#include "apps/arguments.h"
#include "bench/harness/bench_scene.h"
#include "bench/modes/paper/point.h"

// What a paper has published, as data: its tables and figures with their numbers, and what is drawn for each row.
namespace halfsilver::bench {

// Of what was not measured, as errors are without exact rays.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// What a column of a paper's table means here.
struct Quantity {
  std::string name, unit;
  double (*of)(const PaperPoint&);
};

struct PublishedRow {
  std::string label;  // as the paper has it
  std::string scene;  // a name of stageScenes()
  Settings settings;
  std::vector<std::optional<double>> values = {};  // the paper's, by column; none: not in its text, or a row of ours
  std::optional<std::size_t> base = {};            // the row that ratios are taken over
  bool picture = false;                            // is kept for the page
  std::optional<Settings> truth = {};              // of what it is compared with; none: the same with exact rays
};

struct PublishedTable {
  std::string name;  // "Table 2"
  std::string title;
  std::vector<Quantity> quantities;
  std::vector<PublishedRow> rows;
  std::vector<std::string> notes = {};  // what each column and each difference means
};

struct Paper {
  std::string name;      // of its preset
  std::string citation;  // authors, title, year
  std::string machine;   // that its times are of
  Size size;             // of its pictures
  std::vector<PublishedTable> tables;
  std::vector<std::string> missing;  // what it has and this page does not, and why
};

// Scenes under the names by which papers call them.
struct PaperScenes {
  std::vector<BenchScene> scenes;
  std::vector<std::string> standIns;  // which scene stands for which, one line each

  const BenchScene& of(const std::string& name) const;  // throws std::out_of_range
};

// `folder` may hold sponza.glb, bunny.glb and dragon.glb; other scenes stand for those that it does not.
PaperScenes paperScenes(const std::string& folder, bool quick);

std::vector<Paper> publishedPapers(const PaperScenes& scenes, bool quick);
Paper kastrati2017(const PaperScenes& scenes, bool quick);
Paper hu2014(const PaperScenes& scenes, bool quick);
Paper burger2007(const PaperScenes& scenes, bool quick);
Paper beck2005(const PaperScenes& scenes, bool quick);
Paper robert2007(const PaperScenes& scenes, bool quick);

// What tables have in common.
Quantity milliseconds(std::string name, double (*of)(const PaperPoint&));
double buildOf(const PaperPoint& point);      // milliseconds: voxelize, build
double structureOf(const PaperPoint& point);  // megabytes
double framesOf(const PaperPoint& point);     // per second, if each stage follows the other

}  // namespace halfsilver::bench
