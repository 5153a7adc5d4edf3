#pragma once
#include <functional>

#include <nanogui/widget.h>

#include "viewing/view_outputs.h"

namespace robosim {

/// Widget that shows the picture at the window's size and forwards mouse input.
class PictureWidget final : public nanogui::Widget {
 public:
  /// @param source, drawing must outlive this
  /// @param fail called in a handler of an exception thrown during a repaint, which nanogui's loop would ignore
  PictureWidget(nanogui::Widget* parent, ViewSource& source, ViewDrawing& drawing, std::function<void()> fail)
      : Widget(parent), source_(source), drawing_(drawing), fail_(std::move(fail)) {}

  /// Requests drawing before the next repaint.
  void renew() { is_old_ = true; }

  void draw(NVGcontext* context) override;
  bool mouseButtonEvent(const nanogui::Vector2i& p, int button, bool down, int) override;
  bool mouseDragEvent(const nanogui::Vector2i& p, const nanogui::Vector2i& rel, int button, int) override;
  bool scrollEvent(const nanogui::Vector2i& p, const nanogui::Vector2f& rel) override;

 private:
  void upload(NVGcontext* context);

  ViewSource& source_;
  ViewDrawing& drawing_;
  std::function<void()> fail_;
  int image_ = 0;
  nanogui::Vector2i drawn_size_ = nanogui::Vector2i::Zero();
  nanogui::Vector2i pressed_at_ = nanogui::Vector2i::Zero();
  bool is_old_ = true;
};

}  // namespace robosim
