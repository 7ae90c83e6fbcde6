#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <halfsilver/image.h>
#include <halfsilver/model.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>

// halfsilver::io: scenes, images and settings files.
namespace halfsilver {

struct GltfOptions {
  std::string variant;  // of KHR_materials_variants, by name or index; empty: the materials that the primitives name
};

// Reads a glTF 2.0 scene (.gltf or .glb, recognized by content) with all files that it refers to, flattened at rest.
// Model::warnings lists what had to be changed or ignored. Throws Error (badInput), "file: what: where", for anything
// unusable, and Error (usage) for an unknown variant; no input makes it crash or allocate without bound. Buffers and
// images are read from the scene's folder and below it, never from outside.
// Source: the glTF 2.0 specification of the Khronos Group.
Model loadGltf(const std::filesystem::path& file, const GltfOptions& options = {});

// Images in and out. stb reads and writes PNG and reads JPEG and HDR, tinyexr writes EXR. OpenImageIO, if the project
// is built with it, reads EXR and all other formats and compares perceptually; since its 260 shared libraries take a
// quarter of a second to load, it is in a module that is opened on first use (see openimageio_module.h). Without it,
// tinyexr also reads EXR.

struct ImageFile {
  // Channels have the file's names; a picture without names gets R G B A, or Y A if it is gray.
  Image image;
  bool linear = false;  // EXR and HDR: linear radiance. Otherwise display values 0..1, as stored.
  // Attribute "halfsilver:diagonal" of a layer file: the scene's diagonal in meters.
  std::optional<double> diagonal;
};

// Throws Error (badInput) with one line if the file is missing, does not decode or has more than 2^30 values.
ImageFile readImage(const std::filesystem::path& file);

// 8-bit RGBA, rows from the top. `rgba` holds width * height * 4 bytes.
std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> rgba);

// All channels as 32-bit floats under their names, ZIP-compressed; `diagonal` as above.
// Throws Error (failed) if the format cannot hold the image.
std::vector<std::byte> encodeExr(const Image& image, std::optional<double> diagonal = {});

// Reads an equirectangular image (HDR, EXR; display formats are linearized) into the sky. Errors as for readImage.
// Returns how many values had to be clamped to 0..65504: negative, brighter or not a number.
std::size_t readSky(const std::filesystem::path& file, Sky& sky);

struct PerceptualDifference {
  std::uint64_t failures = 0;  // pixels
  double fraction = 0;         // of all pixels
};

// OpenImageIO's comparison after Yee et al. 2001, with its own defaults, on RGB values as they are. Both images must
// have the same size and the channels R G B. Nothing if OpenImageIO is not available.
std::optional<PerceptualDifference> comparePerceptually(const Image& image, const Image& reference);

// Settings in TOML: sections and keys are the settings' names ([voxels] resolution = 64). A file contains only what it
// changes. The presets are the files config/<name>.toml, embedded in the library.

// Applies TOML text to the settings. `name` is the file's name in messages. Throws Error (badInput) with
// "name:line: what" for a syntax error, an unknown key, a value of the wrong type or out of range; the settings are
// then unchanged.
void applySettingsText(Settings& settings, std::string_view text, const std::string& name);

// The same from a file; also throws Error (badInput) if it cannot be read.
void applySettingsFile(Settings& settings, const std::filesystem::path& file);

// TOML text that turns the defaults into these settings: all that differ, and those named in `always` in any case.
std::string settingsText(const Settings& settings, std::span<const std::string> always = {});

struct Preset {
  std::string name;
  std::string description;                                  // one line, the first comment of the file
  std::vector<std::pair<std::string, std::string>> values;  // what differs from the defaults: name, value
};

// All presets, sorted by name.
std::vector<Preset> presets();

// Throws Error (usage) for an unknown name and lists the known ones.
void applyPreset(Settings& settings, std::string_view name);

struct PresetFile {
  std::string_view name;  // without ".toml"
  std::string_view text;
};

// All files config/*.toml, embedded by the build (config/embed_presets.cmake).
std::span<const PresetFile> presetFiles();

// How far an image is from a reference.

// Rays of one kind, of layer files that count them (trace.tally): counts over all pixels. Pixels whose numbers of rays
// differ are left out of the figures after the second.
struct KindComparison {
  std::string kind;                   // "reflection", "shadow", ...
  std::uint64_t rays = 0;             // of the reference
  std::uint64_t unmatched = 0;        // by which the pixels' numbers of rays differ
  std::uint64_t falseOcclusion = 0;   // hits in the image beyond those of the reference
  std::uint64_t falseVisibility = 0;  // the other way round
  std::uint64_t wrongDistance = 0;    // pixels with as many hits whose distances add up to 0.1 % of the diagonal more
                                      // or less
};

// For layer files. All figures are fractions of the pixels selected in either file (0 if there are none); a pixel is a
// hit if its hit.T is at least 0.
struct LayerComparison {
  std::uint64_t pixels = 0;           // selected in either file
  double hitError = 0;                // hit in one file only, or hit.T further apart than 0.1 % of the scene's diagonal
  double falseMiss = 0;               // hit in the reference only
  double falseHit = 0;                // hit in the image only
  double wrongId = 0;                 // hit in both, hit.id differs
  double selectedMismatch = 0;        // selected in one file only
  double overflow = 0;                // given up (hit.T -3) in the image
  std::vector<KindComparison> kinds;  // that one of the files has, if both count them
};

struct Comparison {
  double rmse = 0;      // over R, G, B of all pixels, in the files' own values (PNG: display values 0..1)
  double psnrDb = 0;    // 20 log10(peak / rmse), peak = the larger of 1 and the largest value; infinite if equal
  double maxError = 0;  // largest difference of one channel
  std::optional<PerceptualDifference> perceptual;
  std::optional<LayerComparison> layers;  // if both files have the channels selected.Y, hit.T and hit.id
};

// `diagonal` in meters. Throws Error (badInput) if the sizes differ or a channel is missing.
LayerComparison compareLayers(const Image& image, const Image& reference, double diagonal);

// `diagonal` (meters) overrides that of the files. Throws Error: badInput if the sizes differ, a file has no color
// channels or contains values that are not finite, or the files' diagonals differ; usage if layers are compared and no
// diagonal is known.
Comparison compareImages(const ImageFile& image, const ImageFile& reference, std::optional<double> diagonal = {});

}  // namespace halfsilver
