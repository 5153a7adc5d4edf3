#include "viewing/picture_widget.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nanogui/opengl.h>
#include <nanovg.h>
#include <opencv2/imgproc.hpp>

#include "base/printable_text.h"
#include "viewing/view_keys.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using nanogui::Vector2f;
using nanogui::Vector2i;

/// GLFW's codes of buttons, which nanogui forwards.
constexpr int kLeftButton = 0, kRightButton = 1;
/// How long a notice is shown.
constexpr std::chrono::seconds kNotice(8);

TPoint2D at(const Vector2i& p) { return {static_cast<double>(p.x()), static_cast<double>(p.y())}; }

}  // namespace

void PictureWidget::draw(NVGcontext* context) {
  if (mSize.x() < 1 || mSize.y() < 1) return;
  try {
    if (is_old_ || drawn_size_ != mSize) upload(context);
  } catch (...) {
    return fail_();
  }
  const auto paint =
      nvgImagePattern(context, 0, 0, static_cast<float>(mSize.x()), static_cast<float>(mSize.y()), 0, image_, 1);
  nvgBeginPath(context);
  nvgRect(context, 0, 0, static_cast<float>(mSize.x()), static_cast<float>(mSize.y()));
  nvgFillPaint(context, paint);
  nvgFill(context);
  dragging_.update();
  drawDragged(context);
  drawNotice(context);
}

void PictureWidget::drawDragged(NVGcontext* context) const {
  const auto outline = dragging_.outline();
  if (!outline) return;
  const auto trace = [&](const std::vector<TPoint2D>& line, bool is_closed) {
    nvgBeginPath(context);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto x = static_cast<float>(line[i].x), y = static_cast<float>(line[i].y);
      i == 0 ? nvgMoveTo(context, x, y) : nvgLineTo(context, x, y);
    }
    if (is_closed) nvgClosePath(context);
  };
  const auto stroke = [&](const std::vector<TPoint2D>& line, bool is_closed) {
    // Dark on light, to be seen on every ground.
    for (const auto& [width, color] :
         {std::pair{4.0f, nvgRGBA(255, 255, 255, 200)}, {1.6f, nvgRGBA(20, 25, 32, 255)}}) {
      trace(line, is_closed);
      nvgStrokeWidth(context, width * scale_);
      nvgStrokeColor(context, color);
      nvgStroke(context);
    }
  };
  const auto [red, green, blue] = outline->color;
  stroke(outline->way, false);
  for (const auto& rim : outline->rims) {
    trace(rim, true);
    nvgFillColor(context, nvgRGBAf(red, green, blue, 0.45f));
    nvgFill(context);
  }
  for (std::size_t i = 1; i < outline->rims.size(); ++i) {
    const auto &lower = outline->rims[i - 1], &upper = outline->rims[i];
    const std::size_t corners = std::min(lower.size(), upper.size());
    for (std::size_t k = 0; k < corners; k += std::max<std::size_t>(1, corners / 4))
      stroke({lower[k], upper[k]}, false);
  }
  for (const auto& rim : outline->rims) stroke(rim, true);
  stroke(outline->heading, false);
}

void PictureWidget::drawNotice(NVGcontext* context) {
  const auto now = std::chrono::steady_clock::now();
  if (std::string notice = dragging_.takeNotice(); !notice.empty()) {
    notice_ = printableText(notice);
    noticed_at_ = now;
  }
  if (notice_.empty() || now - noticed_at_ > kNotice) return;
  const float margin = 8 * scale_, width = std::min(static_cast<float>(mSize.x()) - 4 * margin, 700 * scale_);
  nvgFontFace(context, "sans-bold");
  nvgFontSize(context, 16 * scale_);
  nvgTextAlign(context, NVG_ALIGN_LEFT | NVG_ALIGN_TOP);
  float box[4];
  nvgTextBoxBounds(context, 0, 0, width, notice_.c_str(), nullptr, box);
  const float text_width = box[2] - box[0], text_height = box[3] - box[1];
  const float left = (static_cast<float>(mSize.x()) - text_width) / 2;
  const float top = static_cast<float>(mSize.y()) - text_height - 2 * margin;
  nvgBeginPath(context);
  nvgRoundedRect(context, left - margin, top - margin / 2, text_width + 2 * margin, text_height + margin, 6);
  nvgFillColor(context, nvgRGBA(25, 30, 38, 225));
  nvgFill(context);
  nvgFillColor(context, nvgRGB(255, 255, 255));
  nvgTextBox(context, left, top, width, notice_.c_str(), nullptr);
}

bool PictureWidget::mouseButtonEvent(const Vector2i& p, int button, bool down, int modifiers) {
  using How = BodyDragging::How;
  renew();
  if (down && (modifiers & kControl) != 0) {
    has_body_ = dragging_.press(at(p), button == kRightButton ? How::turn : How::move);
    if (has_body_) return true;
  }
  if (has_body_) {
    if (down) return true;
    has_body_ = false;
    dragging_.drag(at(p));
    dragging_.release();
    return true;
  }
  if (button == kLeftButton && down) pressed_at_ = p;
  if (button == kLeftButton && !down && (p - pressed_at_).cwiseAbs().maxCoeff() <= 3) {
    drawing_.panes().click(at(p), source_.snapshot());
  }
  return true;
}

bool PictureWidget::mouseDragEvent(const Vector2i& p, const Vector2i& rel, int button, int) {
  if (has_body_) {
    dragging_.drag(at(p));
    return true;
  }
  // nanogui passes the buttons as bits here.
  const bool right = (button & (1 << kRightButton)) != 0;
  drawing_.panes().drag(at(p), TPoint2D(rel.x(), rel.y()), right ? Panes::Drag::pan : Panes::Drag::turn);
  renew();
  return true;
}

bool PictureWidget::scrollEvent(const Vector2i& p, const Vector2f& rel) {
  drawing_.panes().zoom(at(p), std::pow(1.15, static_cast<double>(rel.y())));
  renew();
  return true;
}

void PictureWidget::upload(NVGcontext* context) {
  cv::Mat rgba;
  cv::cvtColor(drawing_.draw({mSize.x(), mSize.y()}), rgba, cv::COLOR_BGR2RGBA);
  if (drawn_size_ != mSize) {
    if (image_ != 0) nvgDeleteImage(context, image_);
    image_ = nvgCreateImageRGBA(context, mSize.x(), mSize.y(), 0, rgba.data);
    drawn_size_ = mSize;
  } else {
    nvgUpdateImage(context, image_, rgba.data);
  }
  is_old_ = false;
}

}  // namespace robosim
