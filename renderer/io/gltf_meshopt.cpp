#include <meshoptimizer.h>

#include "io/gltf_accessors.h"
#include "io/gltf_decompress.h"

namespace halfsilver::gltf {
namespace {

class View {
 public:
  View(const MeshoptSource& source, std::span<const std::uint8_t> bytes, const Diagnostics& diagnostics,
       std::string where)
      : source_(source), bytes_(bytes), diagnostics_(diagnostics), where_(std::move(where)) {}

  std::vector<std::uint8_t> decode(Diagnostics& budget) const {
    // The codecs write at most so many bytes for one: more is a claim that cannot hold, and not worth memory.
    constexpr std::size_t kLargestRatio = 256, kLargestStride = 256;
    const std::size_t stride = source_.stride;
    if (stride == 0 || stride > kLargestStride) refuse("a byteStride of " + std::to_string(stride));
    if (source_.count > kLargestRatio * (bytes_.size() + 1) / stride + kLargestRatio)
      refuse("a count that its bytes cannot hold");
    budget.spend(source_.count * stride / 4, where_);
    std::vector<std::uint8_t> result(source_.count * stride);
    if (decodeInto(result) != 0) refuse("data that does not decode");
    filter(result);
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    diagnostics_.fail("EXT_meshopt_compression has " + what, where_);
  }

  int decodeInto(std::vector<std::uint8_t>& result) const {
    const std::size_t stride = source_.stride, count = source_.count;
    if (source_.mode == "ATTRIBUTES") {
      if (stride % 4 != 0) refuse("attributes with a byteStride of " + std::to_string(stride));
      return meshopt_decodeVertexBuffer(result.data(), count, stride, bytes_.data(), bytes_.size());
    }
    if (stride != 2 && stride != 4) refuse("indices with a byteStride of " + std::to_string(stride));
    if (source_.mode == "INDICES")
      return meshopt_decodeIndexSequence(result.data(), count, stride, bytes_.data(), bytes_.size());
    if (source_.mode != "TRIANGLES") refuse("the unknown mode \"" + source_.mode.substr(0, 40) + "\"");
    if (count % 3 != 0) refuse("triangles of " + std::to_string(count) + " indices");
    return meshopt_decodeIndexBuffer(result.data(), count, stride, bytes_.data(), bytes_.size());
  }

  void filter(std::vector<std::uint8_t>& result) const {
    const std::string& name = source_.filter;
    const std::size_t stride = source_.stride, count = source_.count;
    if (name.empty() || name == "NONE") return;
    const bool fits = name == "OCTAHEDRAL" ? stride == 4 || stride == 8 : name == "QUATERNION" ? stride == 8 : true;
    if (source_.mode != "ATTRIBUTES" || !fits) refuse("the filter " + name.substr(0, 40) + " where it cannot be");
    if (name == "OCTAHEDRAL")
      meshopt_decodeFilterOct(result.data(), count, stride);
    else if (name == "QUATERNION")
      meshopt_decodeFilterQuat(result.data(), count, stride);
    else if (name == "EXPONENTIAL")
      meshopt_decodeFilterExp(result.data(), count, stride);
    else
      refuse("the unknown filter \"" + name.substr(0, 40) + "\"");
  }

  const MeshoptSource& source_;
  const std::span<const std::uint8_t> bytes_;
  const Diagnostics& diagnostics_;
  const std::string where_;
};

}  // namespace

int addView(Document& document, std::vector<std::uint8_t> bytes, std::size_t stride) {
  document.views.push_back({static_cast<int>(document.buffers.size()), 0, bytes.size(), stride});
  document.buffers.push_back(std::move(bytes));
  return static_cast<int>(document.views.size()) - 1;
}

void expandMeshopt(Document& document, Diagnostics& diagnostics) {
  for (std::size_t v = 0; v < document.views.size(); ++v) {
    if (!document.views[v].meshopt) continue;
    const MeshoptSource source = *document.views[v].meshopt;
    const std::string where = item("bufferViews", v);
    const auto bytes = bytesOf(document, diagnostics, {source.buffer, source.offset, source.length}, where);
    std::vector<std::uint8_t> decoded = View(source, bytes, diagnostics, where).decode(diagnostics);
    BufferView& view = document.views[v];
    // Indices are packed tightly; so are attributes, whose stride is the extension's.
    view = {static_cast<int>(document.buffers.size()), 0, decoded.size(),
            source.mode == "ATTRIBUTES" ? source.stride : 0};
    document.buffers.push_back(std::move(decoded));
  }
}

}  // namespace halfsilver::gltf
