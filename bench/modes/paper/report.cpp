#include "bench/modes/paper/report.h"

#include <cctype>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "bench/report/page.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr int kDigits = 3;  // that count

// With as many digits as count; an exact 0 is one.
std::string shortNumber(std::optional<double> value) {
  if (!value || std::isnan(*value)) return "";
  if (*value == 0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(*value)))) + 1;
  return number(*value, std::max(0, kDigits - before));
}

std::optional<double> ratio(std::optional<double> value, std::optional<double> base) {
  if (!value || !base || *base == 0) return std::nullopt;
  return *value / *base;
}

std::optional<double> publishedValue(const PublishedRow& row, std::size_t column) {
  return column < row.values.size() ? row.values[column] : std::nullopt;
}

// A row's column, both sides.
struct Cell {
  std::optional<double> published, publishedRatio;
  double here = 0;
  std::optional<double> hereRatio;
};

Cell cellOf(const PublishedTable& table, const PaperPoint* points, std::size_t row, std::size_t column) {
  const PublishedRow& own = table.rows[row];
  const auto& of = table.quantities[column].of;
  Cell cell{publishedValue(own, column), {}, of(points[row]), {}};
  if (!own.base || *own.base == row) return cell;
  cell.publishedRatio = ratio(cell.published, publishedValue(table.rows[*own.base], column));
  cell.hereRatio = ratio(cell.here, of(points[*own.base]));
  return cell;
}

std::string unitOf(const Quantity& quantity) { return quantity.unit.empty() ? "" : ", " + quantity.unit; }

// One line per row; two numbers per column, if the paper has any.
Table tableOf(const PublishedTable& table, const PaperPoint* points) {
  Table result{{"Row"}, {}};
  std::vector<bool> published(table.quantities.size(), false);
  for (std::size_t column = 0; column < table.quantities.size(); ++column) {
    for (const PublishedRow& row : table.rows)
      published[column] = published[column] || publishedValue(row, column).has_value();
    const std::string name = table.quantities[column].name + unitOf(table.quantities[column]);
    if (published[column]) {
      result.columns.push_back(name + ": paper");
      result.columns.emplace_back("of base");
    }
    result.columns.push_back(name + ": here");
    result.columns.emplace_back("of base");
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::vector<std::string> cells = {table.rows[row].label};
    for (std::size_t column = 0; column < table.quantities.size(); ++column) {
      const Cell cell = cellOf(table, points, row, column);
      if (published[column]) {
        cells.push_back(shortNumber(cell.published));
        cells.push_back(shortNumber(cell.publishedRatio));
      }
      cells.push_back(shortNumber(cell.here));
      cells.push_back(shortNumber(cell.hereRatio));
    }
    result.rows.push_back(std::move(cells));
  }
  return result;
}

// What each row's picture is worth.
Table errorTable(const PublishedTable& table, const PaperPoint* points) {
  Table result{{"Row", "Wrong rays", "False misses", "False hits", "Wrong triangles", "Perceptible pixels", "RMSE",
                "Structure, MB", "Overflow"},
               {}};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const PaperPoint& point = points[row];
    if (!point.error) continue;
    const ComparisonRecord& error = *point.error;
    const bool mirrors = point.settings.trace.effect == Effect::reflection;
    const auto ofRays = [&](double share) { return mirrors ? percent(share, 2) : std::string(); };
    result.rows.push_back({table.rows[row].label, ofRays(error.hitError), ofRays(error.falseMiss),
                           ofRays(error.falseHit), ofRays(error.wrongId),
                           error.yeeFailFraction ? percent(*error.yeeFailFraction, 2) : "", shortNumber(error.rmse),
                           shortNumber(structureOf(point)), std::to_string(point.overflow)});
  }
  return result;
}

std::vector<Figure> pictures(const Paper& paper, const PublishedTable& table, const OutputFolder& folder) {
  std::vector<Figure> figures;
  for (const PublishedRow& row : table.rows)
    if (row.picture) figures.push_back({readPicture(folder, paperPicture(paper, row)), row.label});
  return figures;
}

}  // namespace

Table paperCsv(const std::vector<Paper>& papers, const std::vector<PaperPoint>& points) {
  Table result{{"paper", "table", "row", "column", "unit", "published", "here", "published_of_base", "here_of_base"},
               {}};
  const PaperPoint* next = points.data();
  for (const Paper& paper : papers)
    for (const PublishedTable& table : paper.tables) {
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        for (std::size_t column = 0; column < table.quantities.size(); ++column) {
          const Cell cell = cellOf(table, next, row, column);
          const Quantity& quantity = table.quantities[column];
          result.rows.push_back({paper.name, table.name, table.rows[row].label, quantity.name, quantity.unit,
                                 shortNumber(cell.published), shortNumber(cell.here), shortNumber(cell.publishedRatio),
                                 shortNumber(cell.hereRatio)});
        }
      next += table.rows.size();
    }
  return result;
}

Table paperSummary(const std::vector<Paper>& papers, const std::vector<PaperPoint>& points) {
  Table table = paperCsv(papers, points);
  constexpr std::size_t kPublished = 5;  // the column
  std::erase_if(table.rows, [](const std::vector<std::string>& row) { return row[kPublished].empty(); });
  return table;
}

std::string paperPicture(const Paper& paper, const PublishedRow& row) {
  std::string name = paper.name + ' ' + row.label;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return name;
}

std::string paperBody(const std::vector<Paper>& papers, const std::vector<std::string>& standIns,
                      const std::vector<PaperPoint>& points, const OutputFolder& folder) {
  std::string body = paragraph(
      "Each table of a paper with its own numbers and those measured here. Milliseconds of other hardware say little: "
      "compare the columns \"of base\", which divide a row by another one of its table, the paper's by the paper's. "
      "Rows that name another preset are not in the paper: they are what the default and exact rays make of the same "
      "task.");
  body += paragraph("Scenes:") + bullets(standIns);
  const PaperPoint* next = points.data();
  for (const Paper& paper : papers) {
    std::string part =
        paragraph(paper.citation + ". Its times: " + paper.machine + ", pictures of " +
                  std::to_string(paper.size.width) + " x " + std::to_string(paper.size.height) +
                  ". Here: " + std::to_string(next->size.width) + " x " + std::to_string(next->size.height) + ".");
    for (const PublishedTable& table : paper.tables) {
      part += heading(table.name + ": " + table.title) + gallery(pictures(paper, table, folder)) +
              toHtml(tableOf(table, next)) + bullets(table.notes);
      const Table errors = errorTable(table, next);
      if (!errors.rows.empty()) part += paragraph("Against exact rays:") + toHtml(errors);
      next += table.rows.size();
    }
    part += heading("Not here") + bullets(paper.missing);
    body += article(paper.name, paper.name, part);
  }
  return body;
}

}  // namespace halfsilver::bench
