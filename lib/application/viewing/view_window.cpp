#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <utility>

#include <nanogui/nanogui.h>
#include <nanogui/opengl.h>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "viewing/picture_widget.h"
#include "viewing/view_keys.h"
#include "viewing/view_outputs.h"
#include "viewing/view_panels.h"

namespace robosim {
namespace {

using nanogui::Vector2i;

/// GLFW's codes of keys, which nanogui forwards.
constexpr int kPressed = 1, kRepeated = 2;
constexpr int kEscape = 256, kRight = 262, kLeft = 263, kF1 = 290, kF11 = 300;

/// On nanogui alone: MRPT's window also loads wxWidgets, Qt and GTK, which takes 0.3 s of processor time.
class ViewWindow final : public nanogui::Screen {
 public:
  ViewWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
             const Panes::Look& look, const ViewLayers& layers, const RobotSelection& only)
      : Screen(Vector2i(size.width_px, size.height_px), "RoboSim: " + printableText(source.title())),
        source_(source),
        times_(times),
        scale_(static_cast<float>(look.scale)),
        drawing_(source, make_panes, layers, only) {
    drawing_.panes().look() = look;
    auto* const theme = new nanogui::Theme(nvgContext());
    theme->mStandardFontSize = static_cast<int>(16 * scale_);
    theme->mButtonFontSize = static_cast<int>(16 * scale_);
    setTheme(theme);
    picture_ = new PictureWidget(this, source_, drawing_, scale_, [this] { fail(); });
    addBar();
    banner_ = new Banner(this, scale_);
    help_ = new HelpPanel(this, scale_);
    if (source_.duration()) {
      source_.seek(times.from_s.value_or(0));
      source_.setSpeed(times.speed.value_or(1));
    }
    performLayout();
    layOut();
  }
  ~ViewWindow() override { setVisible(false); }

  /// Failure while the window was open; exceptions do not pass nanogui's loop.
  std::exception_ptr failure() const { return failure_; }

 private:
  /// Creates the toolbar and, for a recording, the time slider.
  void addBar() {
    bar_ = new nanogui::Widget(this);
    if (source_.canPlay()) {
      pause_ = addButton("Resume", [this] { togglePause(); });
      for (auto* const part :
           {pause_, addButton("Step", [this] { step(); }), addButton("Slower", [this] { changeSpeed(0.5); }),
            addButton("Faster", [this] { changeSpeed(2); })}) {
        playing_.push_back(part);
      }
    }
    addButton("Follow", [this] { drawing_.panes().followNext(source_.snapshot()); });
    addButton("All", [this] { drawing_.panes().showAll(); });
    for (const ViewLayer& layer : viewLayers()) {
      if (layer.key == 0) continue;
      addSwitch(
          layer.label, [this, &layer] { return drawing_.panes().layers().*layer.is_shown; },
          [this, &layer](bool is_on) { setShown(drawing_.panes().layers(), layer, is_on); });
    }
    if (hasCamera(source_.world().fleet)) {
      addSwitch(
          "Camera", [this] { return drawing_.panes().look().camera_inset; },
          [this](bool is_on) { drawing_.panes().look().camera_inset = is_on; });
    }
    addButton("Full screen", [this] { toggleFullScreen(); });
    addButton("?", [this] { toggleHelp(); });
    status_ = bar_->add<nanogui::Label>("0 s");
    if (source_.duration()) {
      slider_ = new nanogui::Slider(this);
      slider_->setCallback([this](float share) {
        source_.seek(share * *source_.duration());
        picture_->renew();
      });
    }
  }

  nanogui::Button* addButton(const std::string& text, const std::function<void()>& action) {
    auto* const button = bar_->add<nanogui::Button>(text);
    button->setCallback([this, action] {
      safely(action);
      picture_->renew();
    });
    return button;
  }
  /// A button that switches a layer, which keys switch as well.
  void addSwitch(const std::string& text, const std::function<bool()>& is_on, const std::function<void(bool)>& set) {
    auto* const button = bar_->add<nanogui::Button>(text);
    button->setFlags(nanogui::Button::ToggleButton);
    button->setChangeCallback([this, set](bool on) {
      set(on);
      picture_->renew();
    });
    switches_.emplace_back(button, is_on);
  }

  /// Called before each repaint of the widgets.
  void drawContents() override {
    safely([this] {
      const auto now = std::chrono::steady_clock::now();
      const double since_s = toSeconds(now - std::exchange(last_, now));
      if (advance(since_s)) picture_->renew();
      if (times_.to_s && source_.duration() && source_.snapshot().time_s >= *times_.to_s) source_.pause(true);
      if (interrupt_.isRequested()) close();
      showStatus();
      layOut();
    });
  }

  /// A lost connection leaves the last picture, with the reason.
  bool advance(double wall_s) {
    if (has_lost_connection_) return false;
    try {
      return source_.advance(wall_s);
    } catch (const ConnectionError& error) {
      has_lost_connection_ = true;
      logWarning("view", error.what());
      banner_->show(printableText(error.what()), true);
      return true;
    }
  }

  /// Lays out the picture and, below it, the toolbar, in as many lines as necessary, and the slider.
  void layOut() {
    const int gap_px = std::max(1, static_cast<int>(5 * scale_));
    int x = gap_px, y = gap_px, line_px = 0;
    for (auto* const part : bar_->children()) {
      const Vector2i size = part->preferredSize(nvgContext());
      if (x > gap_px && x + size.x() > width()) {
        x = gap_px;
        y += line_px + gap_px;
        line_px = 0;
      }
      part->setPosition(Vector2i(x, y + std::max(0, line_px - size.y()) / 2));
      part->setSize(size);
      x += size.x() + gap_px;
      line_px = std::max(line_px, size.y());
    }
    const int bar_px = y + line_px + gap_px, slider_px = slider_ ? static_cast<int>(22 * scale_) : 0;
    const int picture_px = std::max(0, height() - bar_px - slider_px);
    for (auto* const part : {static_cast<nanogui::Widget*>(picture_), static_cast<nanogui::Widget*>(banner_),
                             static_cast<nanogui::Widget*>(help_)}) {
      part->setPosition(Vector2i(0, 0));
      part->setSize(Vector2i(width(), picture_px));
    }
    banner_->setHeight(std::min(picture_px, static_cast<int>(130 * scale_)));  // mouse input below it is the picture's
    bar_->setPosition(Vector2i(0, picture_px));
    bar_->setSize(Vector2i(width(), bar_px));
    if (!slider_) return;
    slider_->setPosition(Vector2i(gap_px, picture_px + bar_px));
    slider_->setSize(Vector2i(std::max(1, width() - 2 * gap_px), slider_px - gap_px));
  }

  /// Once.
  void printRemark() {
    if (is_remark_printed_ || source_.remark().empty()) return;
    logWarning("view", source_.remark());
    is_remark_printed_ = true;
  }

  void showStatus() {
    const auto duration_s = source_.duration();
    std::string text = fixed(source_.snapshot().time_s, 1) + " s";
    if (duration_s) text += " of " + fixed(*duration_s, 1) + " s";
    const double speed = source_.speed();
    if (source_.canPlay()) text += speed == 0 ? ", at full speed" : ", " + fixed(speed, speed < 1 ? 2 : 0) + " x";
    if (const auto so_far_s = source_.readSoFar()) text += "; reading, " + fixed(*so_far_s, 0) + " s";
    // The remark of a recording is long, and is printed.
    if (duration_s && !source_.readSoFar()) printRemark();
    if (duration_s && !source_.remark().empty()) text += "; not whole";
    status_->setCaption(text);
    for (const auto& [button, is_on] : switches_) button->setPushed(is_on());
    if (pause_) pause_->setCaption(source_.isPaused() ? "Resume" : "Pause");
    for (auto* const part : playing_) part->setEnabled(source_.canPlay());
    if (slider_) slider_->setValue(static_cast<float>(source_.snapshot().time_s / std::max(1e-9, *duration_s)));
    if (!has_lost_connection_ && !duration_s) banner_->show(source_.remark(), false);
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
  void toggleHelp() { help_->setVisible(!help_->visible()); }
  void toggleFullScreen() {
    GLFWwindow* const window = glfwWindow();
    if (std::exchange(is_full_screen_, !is_full_screen_)) {
      glfwSetWindowMonitor(window, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], GLFW_DONT_CARE);
      return;
    }
    glfwGetWindowPos(window, &windowed_[0], &windowed_[1]);
    glfwGetWindowSize(window, &windowed_[2], &windowed_[3]);
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode) glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }
  void seekBy(double seconds) {
    if (!source_.duration()) return;
    safely([this, seconds] {
      source_.seek(source_.snapshot().time_s + seconds);
      source_.advance(0);  // the next key event may precede the next repaint
    });
  }

  bool keyboardEvent(int key, int scancode, int action, int modifiers) override {
    // Key repeat applies to seeking, but not to toggles.
    const bool is_wanted = action == kPressed || (action == kRepeated && (key == kLeft || key == kRight));
    return (is_wanted && handle(key, (modifiers & kControl) != 0)) ||
           Screen::keyboardEvent(key, scancode, action, modifiers);
  }
  /// '?' is on different keys in different keyboard layouts.
  bool keyboardCharacterEvent(unsigned codepoint) override {
    if (codepoint != '?') return Screen::keyboardCharacterEvent(codepoint);
    toggleHelp();
    return true;
  }

  bool handle(int key, bool with_control) {
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
        drawing_.panes().followNext(source_.snapshot());
        break;
      case '0':
        drawing_.panes().showAll();
        break;
      case 'C':
        drawing_.panes().look().camera_inset = !drawing_.panes().look().camera_inset;
        break;
      case 'Z':
        if (!with_control) return false;
        [[fallthrough]];
      case 'U':
        picture_->dragging().undo();
        break;
      case 'H':
      case kF1:
        toggleHelp();
        break;
      case kF11:
        toggleFullScreen();
        break;
      case kEscape:
        if (picture_->dragging().isDragging()) {
          picture_->dragging().cancel();
          break;
        }
        if (help_->visible()) {
          help_->setVisible(false);
          break;
        }
        [[fallthrough]];
      case 'Q':
        close();
        break;
      default:
        if (!toggleLayer(key)) return false;
    }
    picture_->renew();
    return true;
  }
  /// @return whether the key is that of a layer
  bool toggleLayer(int key) {
    const auto layers = viewLayers();
    const auto layer = std::find_if(layers.begin(), layers.end(),
                                    [&](const ViewLayer& one) { return one.key != 0 && one.key == key; });
    if (layer == layers.end()) return false;
    ViewLayers& shown = drawing_.panes().layers();
    setShown(shown, *layer, !(shown.*layer->is_shown));
    return true;
  }

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
  float scale_;  ///< of lines and text
  ViewDrawing drawing_;
  // nanogui owns its widgets.
  PictureWidget* picture_ = nullptr;
  Banner* banner_ = nullptr;
  HelpPanel* help_ = nullptr;
  nanogui::Widget* bar_ = nullptr;
  nanogui::Button* pause_ = nullptr;
  std::vector<nanogui::Button*> playing_;  ///< enabled while the source can play
  std::vector<std::pair<nanogui::Button*, std::function<bool()>>> switches_;
  nanogui::Slider* slider_ = nullptr;
  nanogui::Label* status_ = nullptr;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::exception_ptr failure_;
  bool has_lost_connection_ = false;
  bool is_remark_printed_ = false;
  bool is_full_screen_ = false;
  int windowed_[4] = {0, 0, 0, 0};  ///< position and size before full screen
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

void showWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                const Panes::Look& look, const ViewLayers& layers, const RobotSelection& only) {
  std::exception_ptr failure;
  try {
    const Nanogui nanogui;
    nanogui::ref<ViewWindow> window(new ViewWindow(source, make_panes, size, times, look, layers, only));
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
