#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "io/atomic_file.h"
#include "io/small_codecs.h"
#include "temporary_folder.h"

namespace halfsilver {
namespace {

namespace fs = std::filesystem;

void writeBytes(const fs::path& file, std::span<const std::byte> bytes) {
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
}

std::string readText(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A different value in every channel of every pixel.
Image layersImage() {
  Image image{5, 3, {"R", "G", "B", "A", "hit.T", "depth.Z", "normal.X"}, {}};
  for (std::size_t i = 0; i < image.pixelCount() * 7; ++i) image.data.push_back(0.37f * static_cast<float>(i) - 3.0f);
  return image;
}

// The kind of the error and its text; fails if nothing is thrown.
template <class F>
Error errorOf(F&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return Error(ErrorKind::failed, "");
}

TEST(Images, PngKeepsEveryByte) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 7 * 5 * 4; ++i) pixels.push_back(static_cast<std::uint8_t>((i * 37) % 256));
  writeBytes(folder / "a.png", encodePng(7, 5, pixels));
  const ImageFile read = readImage(folder / "a.png");
  EXPECT_FALSE(read.linear);
  ASSERT_EQ(read.image.width, 7);
  ASSERT_EQ(read.image.height, 5);
  ASSERT_EQ(read.image.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    ASSERT_EQ(std::lround(255 * read.image.data[i]), pixels[i]) << "value " << i;
}

TEST(Images, ExrKeepsChannelsByNameAndTheDiagonal) {
  const TemporaryFolder folder;
  const Image image = layersImage();
  writeBytes(folder / "a.exr", encodeExr(image, 12.5));
  const ImageFile read = readImage(folder / "a.exr");
  EXPECT_TRUE(read.linear);
  ASSERT_TRUE(read.diagonal.has_value());
  EXPECT_EQ(*read.diagonal, 12.5);
  ASSERT_EQ(read.image.pixelCount(), image.pixelCount());
  ASSERT_EQ(read.image.channelCount(), image.channelCount());
  for (int c = 0; c < image.channelCount(); ++c) {
    const int other = read.image.channel(image.channels[static_cast<std::size_t>(c)]);
    ASSERT_GE(other, 0) << image.channels[static_cast<std::size_t>(c)];
    for (std::size_t p = 0; p < image.pixelCount(); ++p)
      ASSERT_EQ(image.data[p * 7 + static_cast<std::size_t>(c)],
                read.image.data[p * 7 + static_cast<std::size_t>(other)]);
  }
}

TEST(Images, ExrWithoutDiagonalSaysNone) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.exr", encodeExr(layersImage()));
  EXPECT_FALSE(readImage(folder / "a.exr").diagonal.has_value());
}

TEST(Images, BadFilesAreBadInputWithOneLine) {
  const TemporaryFolder folder;
  std::ofstream(folder / "garbage.png") << "this is not an image at all, whatever its name says";
  std::ofstream(folder / "empty.exr");
  const std::vector<std::byte> exr = encodeExr(layersImage());
  const std::vector<std::byte> png = encodePng(64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 77));
  writeBytes(folder / "half.exr", std::span(exr).first(exr.size() / 2));
  writeBytes(folder / "half.png", std::span(png).first(png.size() / 2));
  for (const char* name : {"missing.png", "garbage.png", "empty.exr", "half.exr", "half.png", "."}) {
    const Error error = errorOf([&] { readImage(folder / name); });
    EXPECT_EQ(error.kind(), ErrorKind::badInput) << name;
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(Images, SkyIsMadeFiniteAndCounted) {
  const TemporaryFolder folder;
  Image image{2, 1, {"R", "G", "B"}, {1.0f, -2.0f, 3.0f, std::numeric_limits<float>::infinity(), NAN, 0.5f}};
  writeBytes(folder / "sky.exr", encodeExr(image));
  Sky sky;
  EXPECT_EQ(readSky(folder / "sky.exr", sky), 3u);
  EXPECT_EQ(sky.imageWidth, 2);
  EXPECT_EQ(sky.imageHeight, 1);
  EXPECT_EQ(sky.image, (std::vector<float>{1.0f, 0.0f, 3.0f, 65504.0f, 0.0f, 0.5f}));
}

TEST(Images, SkyFromADisplayFormatIsLinearized) {
  const TemporaryFolder folder;
  writeBytes(folder / "sky.png", encodePng(1, 1, std::vector<std::uint8_t>{188, 0, 255, 255}));
  Sky sky;
  readSky(folder / "sky.png", sky);
  EXPECT_NEAR(sky.image[0], 0.5029, 1e-3);  // sRGB 188 is half the light
  EXPECT_EQ(sky.image[1], 0.0f);
  EXPECT_FLOAT_EQ(sky.image[2], 1.0f);
}

TEST(AtomicFile, AppearsOnCommitOnly) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.txt");
    file.write("first");
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
  }
  EXPECT_TRUE(fs::is_empty(folder.path())) << "the temporary file stayed";
  AtomicFile file(folder / "a.txt");
  file.write("first");
  file.write("second");
  file.commit();
  EXPECT_EQ(readText(folder / "a.txt"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, KeepsTheOldFileUntilCommitAndLinksStayLinks) {
  const TemporaryFolder folder;
  std::ofstream(folder / "old.txt") << "old";
  fs::create_symlink("old.txt", folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.write("new");
  EXPECT_EQ(readText(folder / "old.txt"), "old");
  file.commit();
  EXPECT_EQ(readText(folder / "old.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
}

TEST(AtomicFile, RefusesWhatCannotBeWrittenAtOnce) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  for (const fs::path& target :
       {folder / "missing" / "a.txt", folder.path(), folder / "file" / "a.txt", fs::path("/dev/null")}) {
    const Error error = errorOf([&] { AtomicFile file(target); });
    EXPECT_EQ(error.kind(), ErrorKind::failed) << target;
    EXPECT_NE(std::string(error.what()).find(target.string()), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(Images, AJpegWhoseTableHasMoreCodesThanBytesIsRefused) {
  std::vector<std::uint8_t> bytes = {0xff, 0xd8, 0xff, 0xfe, 0, 4, 0xff, 0xc4, 0xff, 0xc4, 0x10, 0x13, 0};
  bytes.insert(bytes.end(), 16, 255);  // 4,080 codes
  bytes.resize(5000);
  ImageFile file;
  std::string problem;
  EXPECT_FALSE(decodeSmall(bytes, file, problem));
  EXPECT_EQ(problem, "not an image: a Huffman table has more codes than there are bytes");
  std::vector<std::uint8_t> filled = bytes;
  filled.insert(filled.begin(), 0xff);
  EXPECT_FALSE(decodeSmall(filled, file, problem));
  EXPECT_EQ(problem, "not an image: a Huffman table has more codes than there are bytes");
  Texture texture;
  EXPECT_FALSE(decodeRgba(bytes, texture));
  // What looks like a table in a comment is none: this fails for what it lacks.
  bytes.resize(8);
  EXPECT_FALSE(decodeSmall(bytes, file, problem));
  EXPECT_EQ(problem.find("Huffman"), std::string::npos) << problem;
}

// An HDR file of 12 x 2 texels whose rows are packed: 2, 2, 0, 12, then a run of 12 for each channel.
std::vector<std::uint8_t> packedHdr() {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 12\n";
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  for (int row = 0; row < 2; ++row) {
    bytes.insert(bytes.end(), {2, 2, 0, 12});
    for (const std::uint8_t value : std::initializer_list<std::uint8_t>{128, 64, 0, 129})
      bytes.insert(bytes.end(), {128 + 12, value});
  }
  return bytes;
}

TEST(Images, AnHdrFileThatIsCutOffIsRefused) {
  const std::vector<std::uint8_t> whole = packedHdr();
  ImageFile image;
  std::string problem;
  ASSERT_TRUE(decodeSmall(whole, image, problem)) << problem;
  EXPECT_EQ(image.image.data, [] {
    std::vector<float> texels;
    for (int i = 0; i < 24; ++i) texels.insert(texels.end(), {1, 0.5f, 0});
    return texels;
  }());
  for (std::size_t length = whole.size() - 24; length < whole.size(); ++length) {
    EXPECT_FALSE(decodeSmall(std::span(whole).first(length), image, problem)) << length;
    EXPECT_EQ(problem, "the file is cut off") << length;
  }
  // The same of rows that are not packed.
  std::vector<std::uint8_t> flat(whole.begin(), whole.end() - 24);
  flat.insert(flat.end(), std::size_t{4} * 24, 128);
  EXPECT_TRUE(decodeSmall(flat, image, problem)) << problem;
  flat.pop_back();
  EXPECT_FALSE(decodeSmall(flat, image, problem));
}

TEST(Images, ASizeThatTheBytesCannotHoldIsRefusedAndTakesNoMemory) {
  const std::vector<std::byte> exr = encodeExr(layersImage());
  const std::vector<std::byte> png = encodePng(1, 1, std::vector<std::uint8_t>{1, 2, 3, 4});
  const auto refused = [](std::span<const std::byte> source, const std::string& before, std::size_t after,
                          const std::string& size) {
    std::vector<std::uint8_t> bytes(source.size());
    std::memcpy(bytes.data(), source.data(), source.size());
    const auto at = std::search(bytes.begin(), bytes.end(), before.begin(), before.end());
    ASSERT_NE(at, bytes.end());
    std::copy(size.begin(), size.end(), at + static_cast<std::ptrdiff_t>(before.size() + after));
    ImageFile image;
    std::string problem;
    EXPECT_FALSE(decodeSmall(bytes, image, problem));
    EXPECT_EQ(problem, "not an image of a usable size");
  };
  // Type and length of the attribute and the lower corner come before the upper one.
  refused(exr, "dataWindow", 1 + 6 + 4 + 8, std::string("\xff\x1f\0\0\xff\x1f\0\0", 8));
  refused(png, "IHDR", 0, std::string("\0\0\x20\0\0\0\x20\0", 8));
}

TEST(Images, APngWhoseChunkIsLongerThanTheFileTakesNoMemoryForIt) {
  const std::vector<std::uint8_t> texel = {1, 2, 3, 4};
  std::vector<std::byte> png = encodePng(1, 1, texel);
  std::vector<std::uint8_t> bytes(png.size());
  std::memcpy(bytes.data(), png.data(), png.size());
  ImageFile image;
  std::string problem;
  EXPECT_TRUE(decodeSmall(bytes, image, problem)) << problem;
  bytes[33] = 0x3f;  // the second chunk claims a gigabyte
  EXPECT_FALSE(decodeSmall(bytes, image, problem));
  EXPECT_EQ(problem, "the file is cut off");
}

}  // namespace
}  // namespace halfsilver
