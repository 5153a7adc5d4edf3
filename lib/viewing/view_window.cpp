#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>

#include <mrpt/gui/CDisplayWindowGUI.h>
#include <nanovg.h>
#include <opencv2/imgproc.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "viewing/view_outputs.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using nanogui::Vector2f;
using nanogui::Vector2i;

/// GLFW's codes of keys and buttons, which nanogui forwards.
constexpr int kPressed = 1, kRepeated = 2, kLeftButton = 0, kRightButton = 1;
constexpr int kEscape = 256, kRight = 262, kLeft = 263;

/// Widget that shows the picture at the window's size and forwards mouse input.
class PictureWidget final : public nanogui::Widget {
 public:
  /// @param fail called in a handler of an exception thrown during a repaint, which nanogui's loop would ignore
  PictureWidget(nanogui::Widget* parent, ViewSource& source, ViewDrawing& drawing, std::function<void()> fail)
      : Widget(parent), source_(source), drawing_(drawing), fail_(std::move(fail)) {}

  /// Requests drawing before the next repaint.
  void renew() { is_old_ = true; }

  void draw(NVGcontext* context) override {
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

  bool mouseButtonEvent(const Vector2i& p, int button, bool down, int) override {
    if (button == kLeftButton && down) pressed_at_ = p;
    if (button == kLeftButton && !down && (p - pressed_at_).cwiseAbs().maxCoeff() <= 3) {
      drawing_.panes().click(at(p), source_.snapshot());
    }
    renew();
    return true;
  }
  bool mouseDragEvent(const Vector2i& p, const Vector2i& rel, int button, int) override {
    // nanogui passes the buttons as bits here.
    const bool right = (button & (1 << kRightButton)) != 0;
    drawing_.panes().drag(at(p), TPoint2D(rel.x(), rel.y()), right ? Panes::Drag::pan : Panes::Drag::turn);
    renew();
    return true;
  }
  bool scrollEvent(const Vector2i& p, const Vector2f& rel) override {
    drawing_.panes().zoom(at(p), std::pow(1.15, static_cast<double>(rel.y())));
    renew();
    return true;
  }

 private:
  static TPoint2D at(const Vector2i& p) { return {static_cast<double>(p.x()), static_cast<double>(p.y())}; }

  void upload(NVGcontext* context) {
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

  ViewSource& source_;
  ViewDrawing& drawing_;
  std::function<void()> fail_;
  int image_ = 0;
  Vector2i drawn_size_ = Vector2i::Zero();
  Vector2i pressed_at_ = Vector2i::Zero();
  bool is_old_ = true;
};

class ViewWindow final : public mrpt::gui::CDisplayWindowGUI {
 public:
  ViewWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times)
      : CDisplayWindowGUI("RoboSim: " + printableText(source.title()), static_cast<unsigned>(size.width_px),
                          static_cast<unsigned>(size.height_px)),
        source_(source),
        times_(times),
        drawing_(source, make_panes) {
    picture_ = new PictureWidget(this, source_, drawing_, [this] { fail(); });
    if (source_.canPlay()) addBar();
    if (source_.duration()) {
      source_.seek(times.from_s.value_or(0));
      source_.setSpeed(times.speed.value_or(1));
    }
    addLoopCallback([this] { goOn(); });
    addKeyboardCallback([this](int key, int, int action, int) {
      // Key repeat applies to seeking, but not to toggles.
      const bool is_wanted = action == kPressed || (action == kRepeated && (key == kLeft || key == kRight));
      return is_wanted && handle(key);
    });
    performLayout();
    layOut();
  }

  /// Failure while the window was open; exceptions do not pass nanogui's loop.
  std::exception_ptr failure() const { return failure_; }

 private:
  /// Creates the buttons and, for a recording, the time slider.
  void addBar() {
    bar_ = new nanogui::Window(this, "");
    bar_->setLayout(new nanogui::BoxLayout(nanogui::Orientation::Horizontal, nanogui::Alignment::Middle, 6, 8));
    pause_ = bar_->add<nanogui::Button>("Pause");
    pause_->setFixedWidth(70);
    pause_->setCallback([this] { togglePause(); });
    bar_->add<nanogui::Button>("Step")->setCallback([this] { step(); });
    bar_->add<nanogui::Button>("Slower")->setCallback([this] { changeSpeed(0.5); });
    bar_->add<nanogui::Button>("Faster")->setCallback([this] { changeSpeed(2); });
    if (source_.duration()) {
      slider_ = bar_->add<nanogui::Slider>();
      slider_->setFixedWidth(300);
      slider_->setCallback([this](float share) {
        source_.seek(share * *source_.duration());
        picture_->renew();
      });
    }
    status_ = bar_->add<nanogui::Label>("0 s");
    status_->setFixedWidth(260);
  }

  /// Called before each repaint.
  void goOn() {
    safely([this] {
      const auto now = std::chrono::steady_clock::now();
      const std::chrono::duration<double> since = now - last_;
      last_ = now;
      if (source_.advance(since.count())) picture_->renew();
      if (times_.to_s && source_.duration() && source_.snapshot().time_s >= *times_.to_s) source_.pause(true);
      if (interrupt_.isRequested()) close();
      showStatus();
      layOut();
    });
  }

  /// Lays out the picture and the bar below it.
  void layOut() {
    constexpr int kGap_px = 6;
    const int below_px = bar_ ? bar_->height() + 2 * kGap_px : 0;
    picture_->setPosition(Vector2i(0, 0));
    picture_->setSize(Vector2i(width(), std::max(0, height() - below_px)));
    if (bar_) bar_->setPosition(Vector2i(std::max(0, (width() - bar_->width()) / 2), picture_->height() + kGap_px));
  }

  void showStatus() {
    if (!status_) return;
    const auto duration_s = source_.duration();
    std::string text = fixed(source_.snapshot().time_s, 1) + " s";
    if (duration_s) text += " of " + fixed(*duration_s, 1) + " s";
    const double speed = source_.speed();
    text += speed == 0 ? ", at full speed" : ", " + fixed(speed, speed < 1 ? 2 : 0) + " x";
    // For a recording the remark is long, and has been printed.
    if (const auto remark = source_.remark(); !remark.empty()) text += "; " + (duration_s ? "not whole" : remark);
    status_->setCaption(text);
    pause_->setCaption(source_.isPaused() ? "Resume" : "Pause");
    for (auto* part : bar_->children()) part->setEnabled(source_.canPlay());
    if (slider_) slider_->setValue(static_cast<float>(source_.snapshot().time_s / std::max(1e-9, *duration_s)));
  }

  /// @name Actions of the bar and the keys, if playback can be controlled
  ///@{
  void togglePause() {
    if (source_.canPlay()) safely([this] { source_.pause(!source_.isPaused()); });
  }
  void step() {
    if (source_.canPlay()) safely([this] { source_.step(); });
  }
  void changeSpeed(double factor) {
    const double speed = source_.speed();
    if (!source_.canPlay() || (speed == 0 && factor > 1)) return;
    safely([&] { source_.setSpeed(speed == 0 ? 1 : std::clamp(speed * factor, 0.01, 1000.0)); });
  }
  ///@}
  void seekBy(double seconds) {
    if (!source_.duration()) return;
    safely([this, seconds] {
      source_.seek(source_.snapshot().time_s + seconds);
      source_.advance(0);  // the next key event may precede the next repaint
    });
  }

  bool handle(int key) {
    switch (key) {
      case ' ':
        togglePause();
        break;
      case 'S':
        step();
        break;
      case '=':
      case '+':
        changeSpeed(2);
        break;
      case '-':
        changeSpeed(0.5);
        break;
      case kLeft:
        seekBy(-5);
        break;
      case kRight:
        seekBy(5);
        break;
      case 'F':
        drawing_.panes().followNext();
        break;
      case '0':
        drawing_.panes().showAll();
        break;
      case 'T':
        toggle(drawing_.panes().layers().paths);
        break;
      case 'V':
        toggle(drawing_.panes().layers().sensors);
        break;
      case 'N':
        toggle(drawing_.panes().layers().names);
        break;
      case 'Q':
      case kEscape:
        close();
        break;
      default:
        return false;
    }
    picture_->renew();
    return true;
  }
  static void toggle(bool& layer) { layer = !layer; }

  /// Runs a callback and stores its exception, because nanogui's loop ignores exceptions.
  template <typename Work>
  void safely(const Work& work) {
    try {
      work();
    } catch (...) {
      fail();
    }
  }
  /// Hides the window, which ends nanogui's loop. nanogui::leave() does so only at the next event: it stops the event
  /// thread at once, but the loop still waits for an event before a repaint.
  void close() { setVisible(false); }
  /// Closes the window; the first failure is kept as the cause.
  void fail() {
    if (!failure_) failure_ = std::current_exception();
    close();
  }

  const Interrupt interrupt_;
  ViewSource& source_;
  ViewTimes times_;
  ViewDrawing drawing_;
  // nanogui owns its widgets.
  PictureWidget* picture_ = nullptr;
  nanogui::Window* bar_ = nullptr;
  nanogui::Button* pause_ = nullptr;
  nanogui::Slider* slider_ = nullptr;
  nanogui::Label* status_ = nullptr;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::exception_ptr failure_;
};

[[noreturn]] void throwNoScreen(const std::string& why) {
  throw ConfigError("there is no screen to open a window on (" + why +
                    "); write a picture instead: --offscreen view.png, or a video: --offscreen view.mp4");
}

/// Initialises nanogui's library for the lifetime of the window.
class Nanogui {
 public:
  Nanogui() {
    const char* const display = std::getenv("DISPLAY");
    if (!display || !*display) throwNoScreen("DISPLAY is not set");
    try {
      nanogui::init();
    } catch (const std::exception&) {
      throwNoScreen("DISPLAY is " + std::string(display) + ", which does not answer");
    }
  }
  ~Nanogui() { nanogui::shutdown(); }
  Nanogui(const Nanogui&) = delete;
  Nanogui& operator=(const Nanogui&) = delete;
};

}  // namespace

void showWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times) {
  std::exception_ptr failure;
  try {
    const Nanogui nanogui;
    nanogui::ref<ViewWindow> window(new ViewWindow(source, make_panes, size, times));
    if (const auto remark = source.remark(); !remark.empty()) logWarning("view", remark);
    window->drawAll();
    window->setVisible(true);
    constexpr int kPeriod_ms = 40;
    nanogui::mainloop(kPeriod_ms, kPeriod_ms);
    failure = window->failure();
  } catch (const ConfigError&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("the window failed: ") + error.what());
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace robosim
