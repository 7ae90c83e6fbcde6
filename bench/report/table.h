#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfsilver::bench {

// Column titles, and rows with as many cells.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string toCsv(const Table& table);   // RFC 4180, lines end with \n
std::string toHtml(const Table& table);  // <table>; numbers are right-aligned
std::string toText(const Table& table);  // aligned, for a terminal

std::string escapeHtml(std::string_view text);

}  // namespace halfsilver::bench
