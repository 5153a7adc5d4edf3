#include "viewing/view_panels.h"

#include <algorithm>

#include <nanogui/opengl.h>

#include "viewing/view_keys.h"

namespace robosim {
namespace {

void fillPanel(NVGcontext* context, float x, float y, float width, float height, const NVGcolor& color) {
  nvgBeginPath(context);
  nvgRoundedRect(context, x, y, width, height, 6);
  nvgFillColor(context, color);
  nvgFill(context);
}

}  // namespace

HelpPanel::HelpPanel(nanogui::Widget* parent, float scale) : Widget(parent), scale_(scale) { setVisible(false); }

bool HelpPanel::mouseButtonEvent(const nanogui::Vector2i&, int, bool down, int) {
  if (down) setVisible(false);
  return true;
}

void HelpPanel::draw(NVGcontext* context) {
  const float lines = static_cast<float>(viewKeys().size());
  // As large as the window permits.
  const float line_px = std::min(24 * scale_, static_cast<float>(height()) / (lines + 2));
  const float width_px = 21 * line_px, height_px = (lines + 1) * line_px;
  const float left = static_cast<float>(position().x()) + (static_cast<float>(width()) - width_px) / 2;
  const float top = static_cast<float>(position().y()) + (static_cast<float>(height()) - height_px) / 2;
  fillPanel(context, left, top, width_px, height_px, nvgRGBA(25, 30, 38, 235));
  nvgFontSize(context, 0.75f * line_px);
  nvgTextAlign(context, NVG_ALIGN_LEFT | NVG_ALIGN_MIDDLE);
  float y = top + line_px;
  for (const auto& [key, meaning] : viewKeys()) {
    nvgFontFace(context, "sans-bold");
    nvgFillColor(context, nvgRGB(255, 214, 120));
    nvgText(context, left + line_px, y, key.c_str(), nullptr);
    nvgFontFace(context, "sans");
    nvgFillColor(context, nvgRGB(240, 243, 247));
    nvgText(context, left + 7 * line_px, y, meaning.c_str(), nullptr);
    y += line_px;
  }
}

Banner::Banner(nanogui::Widget* parent, float scale) : Widget(parent), scale_(scale) { setVisible(false); }

void Banner::show(const std::string& text, bool is_fault) {
  text_ = text;
  is_fault_ = is_fault;
  setVisible(!text.empty());
}

void Banner::draw(NVGcontext* context) {
  const float margin_px = 12 * scale_, size_px = 18 * scale_;
  const float left = static_cast<float>(position().x()) + margin_px,
              top = static_cast<float>(position().y()) + 3 * margin_px;
  const float width_px = static_cast<float>(width()) - 2 * margin_px;
  nvgFontFace(context, "sans-bold");
  nvgFontSize(context, size_px);
  nvgTextAlign(context, NVG_ALIGN_LEFT | NVG_ALIGN_TOP);
  float bounds[4];
  nvgTextBoxBounds(context, left + margin_px, top + margin_px, width_px - 2 * margin_px, text_.c_str(), nullptr,
                   bounds);
  fillPanel(context, left, top, width_px, bounds[3] - bounds[1] + 2 * margin_px,
            is_fault_ ? nvgRGBA(165, 25, 25, 240) : nvgRGBA(25, 30, 38, 225));
  nvgFillColor(context, nvgRGB(255, 255, 255));
  nvgTextBox(context, left + margin_px, top + margin_px, width_px - 2 * margin_px, text_.c_str(), nullptr);
}

}  // namespace robosim
