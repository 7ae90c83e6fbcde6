#include "apps/demo/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/demo/panels.h"

namespace halfsilver::demo {
namespace {

constexpr float kFontPixels = 15;    // at scale 1
constexpr float kBitmapPixels = 13;  // of Dear ImGui's own font, whose outlines are pixels
// First and last characters: Latin, Greek, Cyrillic and punctuation, as names of files and materials have them.
constexpr ImWchar kCharacters[] = {0x20, 0x24f, 0x370, 0x52f, 0x1e00, 0x1eff, 0x2010, 0x205e, 0};

// At its size, so that it is never stretched.
void addFont(ImFontAtlas& fonts, float scale) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(HALFSILVER_DEMO_FONT, ignored) &&
      fonts.AddFontFromFileTTF(HALFSILVER_DEMO_FONT, std::round(kFontPixels * scale), nullptr, kCharacters))
    return;
  ImFontConfig config;
  config.SizePixels = kBitmapPixels * std::max(1.0f, std::round(scale));
  fonts.AddFontDefault(&config);
}

void drawBackdrop(const Backdrop& backdrop, const Size& size) {
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const float top = backdrop.topDown ? 0.0f : 1.0f;
  // Dear ImGui takes a texture's name for a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
  const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(backdrop.texture));
  ImGui::GetBackgroundDrawList()->AddImage(texture, {backdrop.from * width, 0}, {backdrop.to * width, height},
                                           {backdrop.from, top}, {backdrop.to, 1 - top});
}

}  // namespace

Overlay::Overlay(GLFWwindow* window, double scale) : window_(window), context_(ImGui::CreateContext()) {
  ImGui::GetIO().IniFilename = nullptr;
  if (window_) ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
  setScale(scale);
}

Overlay::~Overlay() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void Overlay::setScale(double scale) {
  scale_ = scale;
  area_ = glm::vec2(0);  // so that panels are laid out at the new scale
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  addFont(fonts, static_cast<float>(scale));
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetStyle() = ImGuiStyle();
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4;
  ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale));
}

bool Overlay::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Overlay::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

void Overlay::begin(const Size& size, double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  if (window_) ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  if (!window_) {
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = std::max(1e-4f, static_cast<float>(seconds));
  }
  ImGui::NewFrame();
}

SceneChange Overlay::layOut(const Size& size, double seconds, std::span<const Backdrop> backdrops,
                            OverlayState& state) {
  begin(size, seconds);
  const ImVec2 area = ImGui::GetIO().DisplaySize;
  const Size shown{static_cast<int>(area.x), static_cast<int>(area.y)};
  for (const Backdrop& backdrop : backdrops) drawBackdrop(backdrop, shown);
  state.resized = area_ != glm::vec2(area.x, area.y);
  area_ = {area.x, area.y};
  const auto scale = static_cast<float>(scale_);
  for (const Segment& segment : state.segments)
    ImGui::GetBackgroundDrawList()->AddLine({segment.from.x * area.x, segment.from.y * area.y},
                                            {segment.to.x * area.x, segment.to.y * area.y}, segment.color, scale);
  drawStatus(state, scale);
  SceneChange change;
  if (state.options.split) drawSplitter(state.options, scale);
  if (state.options.keys) drawKeys(state, scale);
  if (state.options.overlay) {
    drawFigures(state, scale);
    change = drawControls(state, scale);
  }
  ImGui::Render();
  return change;
}

void Overlay::layOutProgress(const Size& size, const std::string& what, float done) {
  for (int i = 0; i < 2; ++i) {  // the second knows how high the text is
    begin(size, 1.0 / 60);
    const ImVec2 area = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * area.x, 0.5f * area.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({0.5f * area.x, 0});
    ImGui::Begin("progress", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    ImGui::TextWrapped("%s", what.c_str());
    ImGui::ProgressBar(done, {-1, 0});
    ImGui::End();
    ImGui::Render();
  }
}

void Overlay::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

}  // namespace halfsilver::demo
