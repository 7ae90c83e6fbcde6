#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/methods/attributes.h>
#include <halfsilver/methods/depth_cube.h>
#include <halfsilver/methods/identity.h>
#include <halfsilver/primary_settings.h>
#include <halfsilver/shadow_settings.h>

// Every setting of the renderer, with its unit, range and default. Defaults live here and nowhere else; a preset in
// config/ names only what it changes. Those of one method are in methods/. Settings are read and written by name
// ("voxels.resolution") through the one table in settings.cpp, which the command line, the configuration files and the
// statistics share.
namespace halfsilver {

enum class Posing { gpu, cpu };  // within 1e-5 of the scene's diagonal; in double precision, the reference
enum class SelectMode { none, reflective, all };
enum class SelectPattern {
  scattered,  // evenly over the screen
  region      // in a rectangle of the screen's shape around its center
};
enum class Fill {
  sky,        // the sky's radiance
  neighbours  // what was traced for the pixels around it
};
enum class VoxelRaster {
  voxel,         // rasterized plainly, at voxel resolution
  abuffer,       // at A-buffer resolution
  conservative,  // every voxel that a triangle touches
  shifted        // at voxel resolution, edges shifted by half a texel, one depth each (Kastrati & Goswami 2017)
};
enum class AxisRule {
  normal,  // dominant component of the sum of signed normals (Kastrati & Goswami 2017)
  area,    // dominant component of the sum of absolute normals
  own      // each triangle in its own dominant axis; a voxel keeps a mask of the axes it holds
};
enum class TraceStage { compute, fragment };
enum class Effect {
  reflection,  // mirror reflections, blended with the deferred shading
  whitted,     // reflection, refraction and shadows by rays at every hit
  occlusion,   // how much of the surroundings each surface sees
  path,        // all light, along random paths
  layers       // all surfaces behind each other, see Transfer
};
enum class ToneMap { filmic, none };
enum class Antialiasing {
  none,     // pixels as they are at their centers
  fxaa,     // edges of the tone-mapped picture are smoothed
  temporal  // frames of several offsets, joined over time
};

struct SceneSettings {
  bool cullBackFaces = true;    // single-sided materials are invisible from behind, to the camera and to rays
  Posing posing = Posing::gpu;  // what places the vertices of Renderer::pose(), from the next pose on

  bool operator==(const SceneSettings&) const = default;
};

struct SelectSettings {
  SelectMode mode = SelectMode::reflective;
  float fraction = 1.0f;  // 0..1, share of the selected pixels that is kept; region: of the screen
  SelectPattern pattern = SelectPattern::scattered;
  float maxRoughness = 0.4f;  // 0..1, reflectivity fades from 1 at roughness 0 to 0 here
  float minReflectivity = 0;  // 0..1, pixels at or below are not selected
  // 0..1, pixels that contribute at most this are not kept, and those up to a quarter of an octave above are thinned
  // out. The contribution is what the reflection of something as bright as white adds to the displayed color, after
  // Fresnel, roughness and what the blend leaves of it.
  float minContribution = 0;
  Fill fill = Fill::neighbours;  // the reflection of pixels that reflect and were not traced

  bool operator==(const SelectSettings&) const = default;
};

struct VoxelSettings {
  // Voxels along each axis, 1..512; identity: along the longest, at most, in multiples of four. 0: "auto",
  // see resolutionOf().
  int resolution = 512;
  VoxelRaster raster = VoxelRaster::conservative;
  AxisRule axis = AxisRule::own;

  bool operator==(const VoxelSettings&) const = default;
};

struct ABufferSettings {
  int resolution = 128;  // texels along each axis, 1..4096; identity fragments lie in texels of a voxel's size

  bool operator==(const ABufferSettings&) const = default;
};

// VoxelSettings::resolution, or what it stands for if it is 0: sqrt(3 n) for A-buffers of n x n texels, which Hu et al.
// 2014 (section 5) found best for their method, rounded and within the range.
int resolutionOf(const VoxelSettings& voxels, const ABufferSettings& abuffer);

struct TraceSettings {
  std::string method = "identity";     // a name of methods(), see methods.h
  Effect effect = Effect::reflection;  // which rays there are and what their ends mean
  int bounces = 1;                     // 1..16
  TraceStage stage = TraceStage::compute;
  bool countWork = false;  // each ray's steps and tests are counted, see Renderer::readRayWork()
  bool tally = false;      // each pixel's rays and hits are counted by kind, for the layers

  bool operator==(const TraceSettings&) const = default;
};

// What surfaces add to the light from behind them, and how much they let through, of Effect::layers.
enum class Transfer {
  xray,     // an even skin of each glows and absorbs, more at a slant
  surface,  // lit as in a picture without traced rays
  blend     // lit, with mirror reflections; only materials of AlphaMode::blend let light through
};

// Of effects that send several rays per pixel. A frame's picture is the mean of passes x samples of them.
struct EffectSettings {
  int samples = 8;           // per pixel and pass, 1..64
  int passes = 1;            // of a frame, 1..65536
  bool progressive = false;  // frames go on with the passes of those before while nothing changes
  bool glossy = false;       // reflections of rough surfaces are spread as they are; if not, they are a mirror's
  bool roulette = false;     // paths that carry little light end by chance
  float radius = 0;          // of occlusion, meters; farther things do not count; 0: all do
  int layers = 16;           // surfaces behind each other that are looked at, 1..64
  Transfer transfer = Transfer::xray;
  float opacity = 0.1f;  // of each layer, seen straight on, 0..1

  bool operator==(const EffectSettings&) const = default;
};

struct ImageSettings {
  float exposure = 0;  // stops, -20..20
  ToneMap toneMap = ToneMap::filmic;
  bool motion = false;                             // motion vectors are made, for the layers
  Antialiasing antialiasing = Antialiasing::none;  // of frames in motion; stills: Renderer::refine()

  bool operator==(const ImageSettings&) const = default;
};

struct Settings {
  SceneSettings scene;
  PrimarySettings primary;
  SelectSettings select;
  VoxelSettings voxels;
  ABufferSettings abuffer;
  IdentitySettings identity;
  AttributeSettings attributes;
  DepthCubeSettings depthCube;
  TraceSettings trace;
  EffectSettings effect;
  ShadowSettings shadow;
  ImageSettings image;

  bool operator==(const Settings&) const = default;
};

struct SettingInfo {
  enum class Kind { boolean, integer, real, choice };
  std::string name;   // "section.key"
  std::string value;  // as it would be written after --set
  Kind kind = Kind::real;
  double low = 0, high = 0;          // inclusive, for numbers
  std::vector<std::string> choices;  // for choices; of a number: words that may stand for it
  std::string help;                  // one line, with the unit
};

// Whether the value is one of the words of `choices`, which files put in quotes.
bool isWord(const SettingInfo& info);

// All settings with their present values, in a fixed order.
std::vector<SettingInfo> describe(const Settings& settings);

// Sets one value by name. Throws Error (badInput) for an unknown name, a value of the wrong kind or out of range; the
// message says which, with the range or the choices.
void set(Settings& settings, std::string_view name, std::string_view value);

}  // namespace halfsilver
