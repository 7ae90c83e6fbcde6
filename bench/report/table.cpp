#include "bench/report/table.h"

#include <algorithm>

namespace halfsilver::bench {
namespace {

bool isNumber(const std::string& cell) {
  const std::size_t first = cell.starts_with('-') ? 1 : 0;
  return cell.size() > first && cell[first] >= '0' && cell[first] <= '9';
}

std::string csvCell(const std::string& cell) {
  if (cell.find_first_of("\",\r\n") == cell.npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csvRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) row += ',';
    row += csvCell(cells[i]);
  }
  return row + '\n';
}

std::string htmlRow(const std::vector<std::string>& cells, const std::string& tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells)
    row += '<' + tag + (isNumber(cell) ? " class=\"number\">" : ">") + escapeHtml(cell) + "</" + tag + '>';
  return row + "</tr>\n";
}

}  // namespace

std::string toCsv(const Table& table) {
  std::string text = csvRow(table.columns);
  for (const auto& row : table.rows) text += csvRow(row);
  return text;
}

std::string toHtml(const Table& table) {
  std::string html = "<div class=\"table\"><table>\n<thead>" + htmlRow(table.columns, "th") + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) html += htmlRow(row, "td");
  return html + "</tbody></table></div>\n";
}

std::string toText(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += (i ? "  " : "") + (isNumber(row[i]) ? space + row[i] : row[i] + space);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace halfsilver::bench
