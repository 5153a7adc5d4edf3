#pragma once
#include <string>

#include <nanogui/widget.h>

namespace robosim {

/// Panel over the middle of the picture that lists keys and mouse actions.
class HelpPanel final : public nanogui::Widget {
 public:
  HelpPanel(nanogui::Widget* parent, float scale);
  void draw(NVGcontext* context) override;
  /// A click closes the panel.
  bool mouseButtonEvent(const nanogui::Vector2i&, int, bool down, int) override;

 private:
  float scale_;
};

/// Banner at the upper edge with a text: why nothing moves any more.
class Banner final : public nanogui::Widget {
 public:
  Banner(nanogui::Widget* parent, float scale);
  /// @param is_fault whether it is shown as an error
  void show(const std::string& text, bool is_fault);
  const std::string& text() const { return text_; }
  void draw(NVGcontext* context) override;

 private:
  float scale_;
  std::string text_;
  bool is_fault_ = false;
};

}  // namespace robosim
