#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace halfsilver::bench {

// All points of a mode in one JSON file, which is complete after each of them: an interrupted run resumes where it
// stopped.
class Points {
 public:
  // Reads what the file holds. Throws Error (badInput) if it is not a record of this mode.
  Points(std::filesystem::path file, std::string mode);

  // The point whose members include all of the key's with equal values; null if there is none.
  const nlohmann::ordered_json* find(const nlohmann::ordered_json& key) const;
  void keep(nlohmann::ordered_json point);

 private:
  std::filesystem::path file_;
  nlohmann::ordered_json record_;
};

}  // namespace halfsilver::bench
