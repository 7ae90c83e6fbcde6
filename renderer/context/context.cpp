#include <halfsilver/context.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include "context/backend.h"

namespace halfsilver {
namespace {

// EGL's devices, hardware first, then OSMesa, as far as the kind allows. `lacks` takes why EGL has none.
std::vector<ContextWay> waysOf(ContextKind kind, const ContextOptions& options, std::string& lacks) {
  std::vector<ContextWay> ways;
  if (kind != ContextKind::osmesa) {
    try {
      ways = eglWays(options);
    } catch (const Error& error) {
      lacks = std::string("EGL: ") + error.what();
    }
  }
  if (kind != ContextKind::egl) ways.push_back(osmesaWay(options));
  return ways;
}

// Of a current context.
std::string rendererOf(const Context::Backend& backend) {
  constexpr unsigned kRenderer = 0x1F01;  // GL_RENDERER
  using GetString = const unsigned char* (*)(unsigned name);
  const auto getString = reinterpret_cast<GetString>(backend.getProcAddress()("glGetString"));
  const unsigned char* text = getString ? getString(kRenderer) : nullptr;
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

bool contains(const std::string& text, const std::string& part) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

// By its place among all devices, or by a part of its name or its renderer's; it has to be of the kind.
Context chosenContext(ContextKind kind, const ContextOptions& options) {
  const std::string& device = options.device;
  std::size_t place = 0;
  const auto [end, error] = std::from_chars(device.data(), device.data() + device.size(), place);
  const bool numbered = error == std::errc() && end == device.data() + device.size();
  std::string known, lacks;
  const std::vector<ContextWay> ways = waysOf(ContextKind::automatic, options, lacks);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const bool fits = kind == ContextKind::automatic || kind == ways[i].kind;
    if (!fits || (numbered && i != place)) continue;
    try {
      std::unique_ptr<Context::Backend> backend = ways[i].make();
      const std::string renderer = rendererOf(*backend);
      if (numbered || contains(ways[i].name, device) || contains(renderer, device)) return Context(std::move(backend));
      known += (known.empty() ? "" : ", ") + std::to_string(i) + " " + renderer + " (" + ways[i].name + ")";
    } catch (const Error& refused) {
      known += (known.empty() ? "" : ", ") + std::to_string(i) + " " + ways[i].name + ": " + refused.what();
    }
  }
  throw Error(ErrorKind::noContext,
              "there is no device '" + device + "'" + (known.empty() ? " of that kind" : " (" + known + ")"));
}

}  // namespace

Context::Context(std::unique_ptr<Backend> backend, std::string passedOver)
    : backend_(std::move(backend)), passedOver_(std::move(passedOver)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

const char* Context::name() const { return backend_->name(); }
std::function<Context::Proc(const char*)> Context::getProcAddress() const { return backend_->getProcAddress(); }
void Context::makeCurrent() { backend_->makeCurrent(); }
void Context::release() { backend_->release(); }

std::vector<ContextDevice> contextDevices(const ContextOptions& options) {
  std::vector<ContextDevice> devices;
  std::string lacks;
  for (const ContextWay& way : waysOf(ContextKind::automatic, options, lacks)) {
    ContextDevice& device = devices.emplace_back(ContextDevice{way.kind, way.name, {}, {}});
    try {
      device.renderer = rendererOf(*way.make());
    } catch (const Error& error) {
      device.lacks = error.what();
    }
  }
  return devices;
}

Context makeContext(ContextKind kind, const ContextOptions& options) {
  if (!options.device.empty()) return chosenContext(kind, options);
  std::string lacks;
  const std::vector<ContextWay> ways = waysOf(kind, options, lacks);
  std::string passedOver;
  ContextKind before = ContextKind::automatic;
  for (const ContextWay& way : ways) {
    try {
      return Context(way.make(), passedOver);
    } catch (const Error& error) {
      passedOver += (passedOver.empty() ? "" : ", ") + way.name + ": " + error.what();
      const std::string what = way.kind == ContextKind::osmesa ? std::string("OSMesa: ") + error.what()
                               : before == way.kind            ? way.name + ": " + error.what()
                                                               : "EGL: " + way.name + ": " + error.what();
      lacks += (lacks.empty() ? "" : before == way.kind ? ", " : "; ") + what;
      before = way.kind;
    }
  }
  throw Error(ErrorKind::noContext, "no OpenGL 4.5 core context: " + lacks);
}

}  // namespace halfsilver
