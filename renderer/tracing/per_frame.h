#pragma once

#include <array>
#include <cstddef>

#include <halfsilver/products.h>

namespace halfsilver {

// What a method keeps for each of the two frames that may be under way, which are told apart by their G-buffers.
template <class T>
class PerFrame {
 public:
  // That of a frame which begins: its own, or the older one of the two.
  T& begin(const GBuffer& gbuffer) {
    if (entries_[latest_].of != &gbuffer) latest_ = 1 - latest_;
    entries_[latest_].of = &gbuffer;
    return entries_[latest_].kept;
  }

  // That of a frame which has begun; null if it has not.
  const T* find(const GBuffer& gbuffer) const {
    for (const Entry& entry : entries_)
      if (entry.of == &gbuffer) return &entry.kept;
    return nullptr;
  }
  // Of one that has.
  const T& of(const GBuffer& gbuffer) const { return *find(gbuffer); }

  template <class Visit>
  void each(const Visit& visit) {
    for (Entry& entry : entries_) visit(entry.kept);
  }
  template <class Visit>
  void each(const Visit& visit) const {
    for (const Entry& entry : entries_) visit(entry.kept);
  }

 private:
  struct Entry {
    const GBuffer* of = nullptr;
    T kept;
  };
  std::array<Entry, 2> entries_;
  std::size_t latest_ = 0;
};

}  // namespace halfsilver
