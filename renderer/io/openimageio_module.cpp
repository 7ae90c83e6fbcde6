#include "io/openimageio_module.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <limits>

// The only file that includes OpenImageIO.
namespace halfsilver {
namespace {

// Copies R, G and B into a buffer of three channels.
OIIO::ImageBuf colorBuffer(const Image& image) {
  OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT));
  std::vector<float> rgb(image.pixelCount() * 3);
  const std::size_t stride = static_cast<std::size_t>(image.channelCount());
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(image.channel(names[c]));
    for (std::size_t p = 0; p < image.pixelCount(); ++p) rgb[p * 3 + c] = image.data[p * stride + channel];
  }
  buffer.set_pixels(OIIO::get_roi(buffer.spec()), OIIO::TypeDesc::FLOAT, rgb.data());
  return buffer;
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

extern "C" {

OpenImageIoRead halfsilver_openimageio_read;
OpenImageIoCompare halfsilver_openimageio_compare;

bool halfsilver_openimageio_read(const std::string& file, ImageFile& result, std::string& problem) {
  OIIO::ImageSpec options;
  options["oiio:UnassociatedAlpha"] = 1;  // values as stored
  const auto input = OIIO::ImageInput::open(file, &options);
  if (!input) {
    problem = firstLine(OIIO::geterror());
    return false;
  }
  const OIIO::ImageSpec spec = input->spec();
  const double values = double(spec.width) * double(spec.height) * double(spec.nchannels);
  if (spec.deep || spec.depth > 1 || spec.width < 1 || spec.height < 1 || values > double(1 << 30)) {
    problem = "not a flat image of a usable size";
    return false;
  }
  Image image{spec.width, spec.height, spec.channelnames, {}};
  image.data.resize(image.pixelCount() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.data.data())) {
    problem = firstLine(input->geterror());
    return false;
  }
  const std::string format = input->format_name();
  result.image = std::move(image);
  result.linear = format == "openexr" || format == "hdr";
  if (const OIIO::ParamValue* diagonal = spec.find_attribute("halfsilver:diagonal"))
    result.diagonal = diagonal->get_float();
  return true;
}

bool halfsilver_openimageio_compare(const Image& image, const Image& reference, PerceptualDifference& result) {
  OIIO::ImageBufAlgo::CompareResults details;
  const int failures = OIIO::ImageBufAlgo::compare_Yee(colorBuffer(image), colorBuffer(reference), details);
  result.failures = static_cast<std::uint64_t>(std::max(failures, 0));
  result.fraction = static_cast<double>(result.failures) / static_cast<double>(image.pixelCount());
  return true;
}

}  // extern "C"

}  // namespace halfsilver
