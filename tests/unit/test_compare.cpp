#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <halfsilver/error.h>
#include <halfsilver/io.h>

namespace halfsilver {
namespace {

ImageFile gradient(int width, int height) {
  ImageFile file;
  file.image = {width, height, {"R", "G", "B", "A"}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const float value : {static_cast<float>(x) / static_cast<float>(width),
                                static_cast<float>(y) / static_cast<float>(height), 0.5f, 1.0f})
        file.image.data.push_back(value);
  return file;
}

// A layer file of one row with the given pixels.
struct Pixel {
  float selected, t, id;
};
ImageFile layers(const std::vector<Pixel>& pixels, std::optional<double> diagonal = 100.0) {
  ImageFile file;
  file.linear = true;
  file.diagonal = diagonal;
  file.image = {static_cast<int>(pixels.size()), 1, {"R", "G", "B", "selected.Y", "hit.T", "hit.id"}, {}};
  for (const Pixel& p : pixels) file.image.data.insert(file.image.data.end(), {0, 0, 0, p.selected, p.t, p.id});
  return file;
}

TEST(Compare, EqualImagesHaveNoError) {
  const ImageFile image = gradient(32, 32);
  const Comparison c = compareImages(image, image);
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(c.maxError, 0);
  EXPECT_TRUE(std::isinf(c.psnrDb));
  EXPECT_FALSE(c.layers.has_value());
  EXPECT_EQ(c.perceptual.has_value(), HALFSILVER_OPENIMAGEIO == 1);
  if (c.perceptual) {
    EXPECT_EQ(c.perceptual->failures, 0u);
  }
}

TEST(Compare, KnownErrors) {
  const ImageFile reference = gradient(32, 32);
  ImageFile image = reference;
  image.image.data[0] += 0.5f;  // R of one pixel
  image.image.data[3] = 0;      // alpha does not count
  const Comparison c = compareImages(image, reference);
  EXPECT_FLOAT_EQ(static_cast<float>(c.maxError), 0.5f);
  const double rmse = std::sqrt(0.25 / (32 * 32 * 3));
  EXPECT_NEAR(c.rmse, rmse, 1e-9);
  EXPECT_NEAR(c.psnrDb, -20 * std::log10(rmse), 1e-6);
}

TEST(Compare, PerceptualFindsALargeDifference) {
  if (!HALFSILVER_OPENIMAGEIO) GTEST_SKIP() << "built without OpenImageIO";
  const ImageFile reference = gradient(64, 64);
  ImageFile image = reference;
  for (std::size_t i = 0; i < image.image.data.size() / 2; ++i) image.image.data[i] = 1 - image.image.data[i];
  const Comparison c = compareImages(image, reference);
  ASSERT_TRUE(c.perceptual.has_value());
  EXPECT_GT(c.perceptual->failures, 500u);
  EXPECT_NEAR(c.perceptual->fraction, static_cast<double>(c.perceptual->failures) / (64 * 64), 1e-12);
}

TEST(Compare, LayersAgainstCountsMadeByHand) {
  // One pixel per case; the first two are selected in neither file and do not count.
  const ImageFile image = layers({{0, -2, -1},
                                  {0, -2, -1},
                                  {1, 5.0f, 7},   // same
                                  {1, 5.05f, 7},  // within 0.1 m
                                  {1, 5.2f, 7},   // too far
                                  {1, 5.0f, 8},   // wrong id
                                  {1, -1, -1},    // false miss
                                  {1, -3, -1},    // given up: also a false miss
                                  {1, 4.0f, 3},   // false hit
                                  {0, -2, -1},    // selected in the reference only, where it hit
                                  {1, -1, -1}});  // selected in the image only; no hit in either
  const ImageFile reference = layers({{0, -2, -1},
                                      {0, -2, -1},
                                      {1, 5.0f, 7},
                                      {1, 5.0f, 7},
                                      {1, 5.0f, 7},
                                      {1, 5.0f, 7},
                                      {1, 5.0f, 7},
                                      {1, 5.0f, 7},
                                      {1, -1, -1},
                                      {1, 5.0f, 7},
                                      {0, -2, -1}});
  const Comparison c = compareImages(image, reference);
  ASSERT_TRUE(c.layers.has_value());
  EXPECT_EQ(c.layers->pixels, 9u);
  EXPECT_DOUBLE_EQ(c.layers->hitError, 5.0 / 9);
  EXPECT_DOUBLE_EQ(c.layers->falseMiss, 3.0 / 9);
  EXPECT_DOUBLE_EQ(c.layers->falseHit, 1.0 / 9);
  EXPECT_DOUBLE_EQ(c.layers->wrongId, 1.0 / 9);
  EXPECT_DOUBLE_EQ(c.layers->selectedMismatch, 2.0 / 9);
  EXPECT_DOUBLE_EQ(c.layers->overflow, 1.0 / 9);
}

TEST(Compare, NothingSelectedIsNoError) {
  const ImageFile file = layers({{0, -2, -1}, {0, -2, -1}});
  const Comparison c = compareImages(file, file);
  ASSERT_TRUE(c.layers.has_value());
  EXPECT_EQ(c.layers->pixels, 0u);
  EXPECT_EQ(c.layers->hitError, 0);
}

TEST(Compare, DiagonalComesFromEitherFileOrTheCaller) {
  const std::vector<Pixel> near = {{1, 5.0f, 7}}, far = {{1, 5.2f, 7}};
  EXPECT_EQ(compareImages(layers(far, {}), layers(near, 100.0)).layers->hitError, 1);
  EXPECT_EQ(compareImages(layers(far, 100.0), layers(near, {})).layers->hitError, 1);
  EXPECT_EQ(compareImages(layers(far, {}), layers(near, {}), 1000.0).layers->hitError, 0);
  EXPECT_THROW(compareImages(layers(far, {}), layers(near, {})), Error);
  EXPECT_THROW(compareImages(layers(far, 100.0), layers(near, 90.0)), Error);
}

TEST(Compare, RejectsWhatCannotBeCompared) {
  const ImageFile a = gradient(8, 8), b = gradient(8, 9);
  const auto kindOf = [](const ImageFile& image, const ImageFile& reference) {
    try {
      compareImages(image, reference);
    } catch (const Error& error) {
      return static_cast<int>(error.kind());
    }
    return 0;
  };
  EXPECT_EQ(kindOf(a, b), 3);
  ImageFile linear = a, broken = a, colorless = a;
  linear.linear = true;
  broken.image.data[5] = std::numeric_limits<float>::quiet_NaN();
  colorless.image.channels = {"X", "Z", "U", "V"};
  EXPECT_EQ(kindOf(linear, a), 3);
  EXPECT_EQ(kindOf(broken, a), 3);
  EXPECT_EQ(kindOf(a, broken), 3);
  EXPECT_EQ(kindOf(colorless, a), 3);
  EXPECT_THROW(compareLayers(a.image, a.image, 1), Error) << "no layers";
  EXPECT_THROW(compareLayers(layers({{1, 1, 1}}).image, layers({{1, 1, 1}, {1, 1, 1}}).image, 1), Error);
}

}  // namespace
}  // namespace halfsilver
