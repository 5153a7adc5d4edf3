#include "viewing/picture_widget.h"

#include <cmath>

#include <nanogui/opengl.h>
#include <nanovg.h>
#include <opencv2/imgproc.hpp>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using nanogui::Vector2f;
using nanogui::Vector2i;

/// GLFW's codes of buttons, which nanogui forwards.
constexpr int kLeftButton = 0, kRightButton = 1;

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
}

bool PictureWidget::mouseButtonEvent(const Vector2i& p, int button, bool down, int) {
  if (button == kLeftButton && down) pressed_at_ = p;
  if (button == kLeftButton && !down && (p - pressed_at_).cwiseAbs().maxCoeff() <= 3) {
    drawing_.panes().click(at(p), source_.snapshot());
  }
  renew();
  return true;
}

bool PictureWidget::mouseDragEvent(const Vector2i& p, const Vector2i& rel, int button, int) {
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
