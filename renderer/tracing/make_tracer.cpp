#include <halfsilver/error.h>
#include <halfsilver/tracer.h>
#include "tracing/attributes/attribute_tracer.h"
#include "tracing/identity/identity_tracer.h"

namespace halfsilver {

std::unique_ptr<Tracer> makeTracer(const gl::Api& api, const Settings& settings, const TracerFactory& exact) {
  switch (settings.trace.method) {
    case Method::none:
      return nullptr;
    case Method::attributes:
      return std::make_unique<AttributeTracer>(api, settings);
    case Method::automatic:
      // On a software rasterizer the CPU's own rays are many times faster than the A-buffer.
      if (api.software && exact) return exact(api, settings);
      [[fallthrough]];
    case Method::identity:
      return std::make_unique<IdentityTracer>(api, settings);
    case Method::exact:
      if (!exact) throw Error(ErrorKind::usage, "trace.method=exact needs an exact tracer (halfsilver::exact)");
      return exact(api, settings);
  }
  throw Error(ErrorKind::usage, "unknown trace.method");
}

}  // namespace halfsilver
