#include <halfsilver/methods.h>

#include <algorithm>

#include <halfsilver/error.h>
#include <halfsilver/tracer.h>
#include "tracing/attributes/attribute_tracer.h"
#include "tracing/bvh/bvh_tracer.h"
#include "tracing/cubemap/cubemap_tracer.h"
#include "tracing/depth_cube/depth_cube_tracer.h"
#include "tracing/identity/identity_tracer.h"
#include "tracing/planar/planar_tracer.h"
#include "tracing/screen/screen_tracer.h"
#include "tracing/screen_first/screen_first_tracer.h"
#include "tracing/voxels/voxel_tracer.h"

namespace halfsilver {
namespace {

// The table: a method is one row.
const std::vector<Method>& table() {
  static const std::vector<Method> rows = {
      {{.name = "none", .help = "no tracing"}, [](const gl::Api&, const Settings&) { return nullptr; }},
      AttributeTracer::method(),
      DepthCubeTracer::method(),
      VoxelTracer::method(),
      IdentityTracer::method(),
      BvhTracer::method(),
      ScreenTracer::method(),
      ScreenFirstTracer::method(IdentityTracer::method()),
      PlanarTracer::method(),
      CubemapTracer::method(),
      {{.name = "exact", .help = "exact rays on the CPU (halfsilver::exact)", .exact = true}, {}},
      {{.name = "auto",
        .help = "the fastest of those without errors, see <halfsilver/calibration.h>; a renderer takes exact on a "
                "software rasterizer, otherwise identity"},
       {}},
  };
  return rows;
}

const Method* find(std::span<const Method> rows, std::string_view name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Method& each) { return each.info.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

// The method that the settings stand for on this device.
const Method& chosen(const gl::Api& api, const Settings& settings, std::span<const Method> brought) {
  std::string_view name = settings.trace.method;
  // On a software rasterizer the CPU's own rays are many times faster than the A-buffer.
  if (name == "auto") name = api.software && find(brought, "exact") ? "exact" : "identity";
  if (const Method* row = find(brought, name)) return *row;
  if (const Method* row = find(table(), name)) return *row;
  throw Error(ErrorKind::usage, "unknown trace.method '" + settings.trace.method + "'");
}

}  // namespace

std::span<const MethodInfo> methods() {
  static const std::vector<MethodInfo> infos = [] {
    std::vector<MethodInfo> all;
    for (const Method& row : table()) all.push_back(row.info);
    return all;
  }();
  return infos;
}

const MethodInfo& methodInfo(std::string_view name) {
  if (const Method* row = find(table(), name)) return row->info;
  throw Error(ErrorKind::usage, "unknown trace.method '" + std::string(name) + "'");
}

std::unique_ptr<Tracer> makeTracer(const gl::Api& api, const Settings& settings, std::span<const Method> brought) {
  const Method& method = chosen(api, settings, brought);
  if (!method.make)
    throw Error(ErrorKind::usage, "trace.method=" + method.info.name + " needs a tracer that the caller brings");
  return method.make(api, settings);
}

bool hasTracer(std::string_view method, std::span<const Method> brought) {
  const Method *ours = find(table(), method), *theirs = find(brought, method);
  return (theirs && theirs->make) || (ours && ours->make);
}

bool sameTracer(const gl::Api& api, const Settings& a, const Settings& b, std::span<const Method> brought) {
  if (a == b) return true;
  const MethodInfo &before = chosen(api, a, brought).info, &after = chosen(api, b, brought).info;
  if (before.name != after.name) return false;
  const std::vector<SettingInfo> old = describe(a), wanted = describe(b);
  for (std::size_t i = 0; i < old.size(); ++i)
    if (old[i].value != wanted[i].value &&
        std::find(after.settings.begin(), after.settings.end(), old[i].name) != after.settings.end())
      return false;
  return true;
}

}  // namespace halfsilver
