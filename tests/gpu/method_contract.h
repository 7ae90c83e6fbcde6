#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/tracer.h>
#include "gpu/tracing_scenes.h"
#include "temporary_folder.h"

namespace halfsilver::testing {

struct MethodCase {
  const char* name;
  const char* preset;
  std::vector<std::pair<const char*, const char*>> settings;
  double maxHitError;  // on soup(600); of methods that are not exact: a third above what was measured
  // A method that the table does not have: it is brought to the renderer, and its name takes the preset's place.
  Method (*brought)() = nullptr;
  const char* shaders = nullptr;  // folder below tests/: its shaders, beside the project's own

  friend std::ostream& operator<<(std::ostream& out, const MethodCase& method) { return out << method.name; }
};

// The contract of the methods, test_method_contract.cpp: an instance of this suite runs it over a method.
class MethodTest : public TracingTest, public ::testing::WithParamInterface<MethodCase> {
 protected:
  MethodTest();
  ~MethodTest() override;

  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {});
  std::vector<Method> methods(const Scene& scene) const override;

 private:
  std::optional<TemporaryFolder> shaders_;
};

}  // namespace halfsilver::testing
