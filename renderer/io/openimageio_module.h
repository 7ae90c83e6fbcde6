#pragma once

#include <string>

#include <halfsilver/io.h>

// The interface of the module halfsilver_openimageio, which images.cpp opens with dlopen. Both sides are built
// together, so C++ types may cross the boundary; only the two names have C linkage.
namespace halfsilver {

inline constexpr const char* kOpenImageIoModule = "libhalfsilver_openimageio.so";
inline constexpr const char* kReadFunction = "halfsilver_openimageio_read";
inline constexpr const char* kCompareFunction = "halfsilver_openimageio_compare";

// Returns false with one line in `problem`; throws nothing but std::bad_alloc.
using OpenImageIoRead = bool(const std::string& file, ImageFile& result, std::string& problem);
using OpenImageIoCompare = bool(const Image& image, const Image& reference, PerceptualDifference& result);

}  // namespace halfsilver
