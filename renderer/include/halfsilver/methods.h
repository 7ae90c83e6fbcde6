#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The methods of tracing rays, as one table. Settings, tuning and benchmarks learn of methods here and nowhere else.
namespace halfsilver {

class Tracer;
struct Settings;
namespace gl {
struct Api;
}

// A setting that trades time and memory for accuracy.
struct Knob {
  std::string setting;              // "section.key"
  std::vector<std::string> values;  // worth trying; of a method's last knob in the order of growing memory
};

struct MethodInfo {
  std::string name;  // value of trace.method
  std::string help;  // one line
  // What its tracer is made from, as "section.key". A change of any other setting keeps the tracer and its structure.
  std::vector<std::string> settings = {};
  // The structure has the size that voxels.resolution and abuffer.resolution say, whatever the scene.
  bool fixedResolution = false;
  std::string preset = {};       // where tuning starts; empty: there is nothing to tune
  std::vector<Knob> knobs = {};  // what tuning varies
  bool exact = false;            // its hits are those of exact rays: trace.method=auto may choose it
};

// Makes the tracer of one method.
using TracerFactory = std::function<std::unique_ptr<Tracer>(const gl::Api&, const Settings&)>;

struct Method {
  MethodInfo info;
  TracerFactory make;  // empty: the caller of the renderer brings it
};

// All methods that trace.method may name, in a fixed order.
std::span<const MethodInfo> methods();

// The row of that name. Throws Error (usage) if there is none.
const MethodInfo& methodInfo(std::string_view name);

}  // namespace halfsilver
