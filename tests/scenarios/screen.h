#pragma once
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "tests/scenarios/program.h"

struct xcb_connection_t;

namespace robosim {

inline bool isBlue(const cv::Vec3b& pixel) { return pixel[0] > 120 && pixel[2] < 80; }
/// Number of pixels of a BGR picture whose channels are all between those of two colours, inclusive.
int pixelsBetween(const cv::Mat& picture, const cv::Scalar& low, const cv::Scalar& high);
/// Number of pixels for which isBlue().
int bluesIn(const cv::Mat& picture);
/// Number of pixels that are not black.
int litsIn(const cv::Mat& picture);

/// A virtual X server (Xvfb), with inspection of its screen. It does not reset when the last client disconnects, which
/// would reject the next one, and does not repeat keys that are released late on a slow machine.
class Screen {
 public:
  Screen();
  ~Screen();

  /// Prefix for act() that sends keys, named as in `xdotool`, to the focused window (0) rather than to a given window:
  /// if a key closes the window, its release would go to that window, and the server would consider the key pressed and
  /// not report it to the next window.
  static std::string keys(const std::string& names) { return "windowfocus key --window 0 " + names; }
  /// Runs `xdotool` on RoboSim's window.
  void act(const std::string& what) const { runCommand("xdotool search --name RoboSim " + what); }

  /// The screen, 1024 × 768, as the server has it between two requests of its clients.
  cv::Mat shot() const;
  /// The first picture of the screen that satisfies a predicate; the last one when the program has ended, or after
  /// kLongestWait.
  cv::Mat waitFor(const std::function<bool(const cv::Mat& screen)>& is_it, StartedProgram& program) const;
  /// What `pixels_in` counts, as soon as it is at least `count`; the last number when the program has ended, or after
  /// kLongestWait.
  int waitForPixels(int count, const std::function<int(const cv::Mat& screen)>& pixels_in,
                    StartedProgram& program) const;

 private:
  StartedProgram server_;
  std::unique_ptr<xcb_connection_t, void (*)(xcb_connection_t*)> connection_;
};

/// Opens a file in one of MRPT's programs with a window. Mesa's software renderer is correct for them only with
/// instructions up to SSE 4.1.
inline StartedProgram startStockWindow(const std::string& program, const std::filesystem::path& file) {
  return StartedProgram("/usr/bin/env", {"HOME=" + file.parent_path().string(), "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
                                         program, file.string()});
}

/// What a program with a window wrote to standard error, without the messages that GLFW 3.4 (Debian 13) adds where no
/// desktop session runs.
inline std::string withoutDesktopMessages(std::string text) {
  for (const std::string message :
       {"error: XDG_RUNTIME_DIR is invalid or not set in the environment.\n", "sh: 1: gsettings: not found\n"}) {
    for (auto at = text.find(message); at != std::string::npos; at = text.find(message)) text.erase(at, message.size());
  }
  return text;
}

}  // namespace robosim
