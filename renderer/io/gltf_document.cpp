#include "io/gltf_document.h"

#include <algorithm>

#include <halfsilver/error.h>
#include "io/one_line.h"

namespace halfsilver::gltf {

void Diagnostics::fail(const std::string& what, const std::string& where) const {
  throw Error(ErrorKind::badInput, oneLine(file + ": " + what + (where.empty() ? "" : ": " + where)));
}

void Diagnostics::warn(const std::string& text) {
  constexpr std::size_t kMaxWarnings = 100;
  if (warnings.size() > kMaxWarnings || std::find(warnings.begin(), warnings.end(), text) != warnings.end()) return;
  warnings.push_back(warnings.size() < kMaxWarnings ? text : "further warnings were omitted");
}

void Diagnostics::spend(std::uint64_t elements, const std::string& where) {
  require(elements, where);
  budget -= elements;
}

void Diagnostics::require(std::uint64_t elements, const std::string& where) const {
  if (elements > budget) fail("expands to more data than is allowed", where);
}

std::string item(const char* list, std::size_t index) { return std::string(list) + "[" + std::to_string(index) + "]"; }

}  // namespace halfsilver::gltf
