#include "bench/report/report.h"

#include <iostream>

#include "io/atomic_file.h"

namespace halfsilver::bench {

void writeReports(const std::filesystem::path& folder, std::span<const Report> reports, const std::string& page) {
  std::vector<std::pair<std::string, std::string>> texts;
  bool missing = false;
  for (const Report& report : reports) {
    for (const auto& [name, table] : report.tables) texts.emplace_back(name + ".csv", toCsv(table));
    if (!report.chart) continue;
    missing = missing || !report.chart->svg;
    if (report.chart->svg) texts.emplace_back(report.name + ".svg", *report.chart->svg);
    if (report.chart->png) texts.emplace_back(report.name + ".png", *report.chart->png);
  }
  texts.emplace_back("index.html", page);
  std::vector<AtomicFile> files;
  for (const auto& [name, text] : texts) files.emplace_back(folder / name).write(text);
  for (AtomicFile& file : files) file.commit();
  if (!missing) return;
  // Charts of an earlier run would not match these tables.
  for (const Report& report : reports)
    for (const char* extension : {".svg", ".png"})
      if (report.chart) std::filesystem::remove(folder / (report.name + extension));
  std::cerr << "warning: gnuplot is not installed (Debian: gnuplot-nox); no charts were written\n";
}

}  // namespace halfsilver::bench
