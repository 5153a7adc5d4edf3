#pragma once
#include <chrono>
#include <functional>
#include <string>

#include <nanogui/widget.h>

#include "viewing/body_dragging.h"
#include "viewing/view_outputs.h"

namespace robosim {

/// Widget that shows the picture at the window's size and forwards mouse input.
class PictureWidget final : public nanogui::Widget {
 public:
  /// @param source, drawing must outlive this
  /// @param fail called in a handler of an exception thrown during a repaint, which nanogui's loop would ignore
  /// @param scale of lines and text
  PictureWidget(nanogui::Widget* parent, ViewSource& source, ViewDrawing& drawing, float scale,
                std::function<void()> fail)
      : Widget(parent),
        source_(source),
        drawing_(drawing),
        scale_(scale),
        dragging_(source, drawing),
        fail_(std::move(fail)) {}

  /// Requests drawing before the next repaint.
  void renew() { is_old_ = true; }
  /// Moving of robots and objects with the mouse, while Ctrl is held.
  BodyDragging& dragging() { return dragging_; }

  void draw(NVGcontext* context) override;
  bool mouseButtonEvent(const nanogui::Vector2i& p, int button, bool down, int modifiers) override;
  bool mouseDragEvent(const nanogui::Vector2i& p, const nanogui::Vector2i& rel, int button, int) override;
  bool scrollEvent(const nanogui::Vector2i& p, const nanogui::Vector2f& rel) override;

 private:
  void upload(NVGcontext* context);
  void drawDragged(NVGcontext* context) const;
  void drawNotice(NVGcontext* context);

  ViewSource& source_;
  ViewDrawing& drawing_;
  float scale_;
  BodyDragging dragging_;
  std::function<void()> fail_;
  int image_ = 0;
  nanogui::Vector2i drawn_size_ = nanogui::Vector2i::Zero();
  nanogui::Vector2i pressed_at_ = nanogui::Vector2i::Zero();
  bool is_old_ = true;
  bool has_body_ = false;  ///< the mouse was pressed on a robot or an object that it moves
  std::string notice_;     ///< about a move
  std::chrono::steady_clock::time_point noticed_at_;
};

}  // namespace robosim
