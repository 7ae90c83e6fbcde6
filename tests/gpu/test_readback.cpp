#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <halfsilver/gl/readback.h>
#include "gpu/context_fixture.h"

namespace halfsilver {
namespace {

class Readbacks : public testing::ContextTest {
 protected:
  gl::Buffer countingFrom(std::uint32_t first, std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), first);
    return gl::makeBuffer<std::uint32_t>(api, values, "numbers");
  }
  // Polls until the copies have arrived: a read-back that never waits must still get there.
  bool arrives(const gl::Readback& readback) const {
    for (int i = 0; i < 1'000'000; ++i)
      if (readback.ready()) return true;
    return false;
  }
  template <class T>
  static std::vector<T> toVector(std::span<const T> values) {
    return {values.begin(), values.end()};
  }
};

TEST_F(Readbacks, CopiesArriveWithoutAWait) {
  const gl::Buffer first = countingFrom(10, 4), second = countingFrom(70, 3);
  gl::Readback readback(api);
  const auto middle = readback.copy<std::uint32_t>(first, 2, 1);
  const auto all = readback.copy<std::uint32_t>(second, 3);
  EXPECT_FALSE(readback.ready()) << "nothing has been submitted";
  readback.submit();
  ASSERT_TRUE(arrives(readback));
  EXPECT_EQ(toVector(readback.values(middle)), (std::vector<std::uint32_t>{11, 12}));
  EXPECT_EQ(toVector(readback.values(all)), (std::vector<std::uint32_t>{70, 71, 72}));
  EXPECT_EQ(*api.hostWaits, 0u);
}

TEST_F(Readbacks, ValuesAreThoseOfTheCopy) {
  gl::Readback readback(api);
  gl::Readback::Slice<std::uint32_t> slice;
  {
    gl::Buffer source = countingFrom(5, 1);
    slice = readback.copy<std::uint32_t>(source);
    source.fill(99);
  }
  readback.submit();
  readback.wait();
  EXPECT_TRUE(readback.ready());
  EXPECT_EQ(readback.values(slice)[0], 5u);
  EXPECT_EQ(*api.hostWaits, 1u);
}

TEST_F(Readbacks, GrowAndKeepWhatCameBefore) {
  constexpr std::size_t kLarge = 40'000;
  const gl::Buffer small = countingFrom(1, 1), large = countingFrom(1000, kLarge);
  gl::Readback readback(api);
  for (std::uint32_t round = 0; round < 3; ++round) {
    readback.clear();
    EXPECT_FALSE(readback.ready());
    std::vector<gl::Readback::Slice<std::uint32_t>> ones;
    for (int i = 0; i < 2000; ++i) ones.push_back(readback.copy<std::uint32_t>(small));
    const auto many = readback.copy<std::uint32_t>(large, kLarge);
    const auto none = readback.copy<std::uint32_t>(large, 0);
    readback.submit();
    readback.wait();
    for (const auto& one : ones) ASSERT_EQ(readback.values(one)[0], 1u);
    ASSERT_EQ(readback.values(many).size(), kLarge);
    EXPECT_EQ(readback.values(many).front(), 1000u);
    EXPECT_EQ(readback.values(many).back(), 1000u + kLarge - 1);
    EXPECT_TRUE(readback.values(none).empty());
  }
}

TEST_F(Readbacks, RequestsThatGrowDoNotPileUp) {
  gl::Readback readback(api);
  constexpr std::size_t kMax = 400'000;
  const gl::Buffer source = countingFrom(0, kMax);
  for (std::size_t count = 1000; count <= kMax; count += 1000) {
    readback.clear();
    const auto slice = readback.copy<std::uint32_t>(source, count);
    readback.submit();
    readback.wait();
    ASSERT_EQ(readback.values(slice).back(), count - 1);
    ASSERT_LE(readback.bytes(), 2 * count * sizeof(std::uint32_t) + (std::size_t{1} << 16)) << count;
  }
}

TEST_F(Readbacks, MovingKeepsTheCopies) {
  const gl::Buffer source = countingFrom(3, 2);
  gl::Readback first(api);
  const auto slice = first.copy<std::uint32_t>(source, 2);
  first.submit();
  gl::Readback second = std::move(first);
  second.wait();
  EXPECT_EQ(toVector(second.values(slice)), (std::vector<std::uint32_t>{3, 4}));
}

TEST_F(Readbacks, BlockingReadsAreCounted) {
  gl::Buffer source = countingFrom(7, 8);
  gl::BlockingRead blocking(api);
  EXPECT_EQ(blocking.read<std::uint32_t>(source, 3), 10u);
  source.fill(21);
  EXPECT_EQ((blocking.read<std::array<std::uint32_t, 2>>(source)), (std::array<std::uint32_t, 2>{21, 21}));
  EXPECT_EQ(*api.hostWaits, 2u);
}

}  // namespace
}  // namespace halfsilver
