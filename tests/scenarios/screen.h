#pragma once
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "tests/scenarios/program.h"

namespace robosim {

inline bool isBlue(const cv::Vec3b& pixel) { return pixel[0] > 120 && pixel[2] < 80; }

/// A virtual X server (Xvfb), with inspection of its screen. It does not reset when the last client disconnects, which
/// would reject the next one, and does not repeat keys that are released late on a slow machine.
class Screen {
 public:
  Screen()
      : server_("/usr/bin/Xvfb",
                {"-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset", "-r"}) {
    server_.waitForOutput("\n");
    display_ = ":" + server_.output().substr(0, server_.output().find('\n'));
    setenv("DISPLAY", display_.c_str(), 1);
    // LeakSanitizer cannot name leaks of window system libraries that have been unloaded. Programs without a window are
    // still checked for leaks.
    // MRPT's nanogui deallocates widgets with another operator delete than programs of C++17 and later require.
    setenv("ASAN_OPTIONS", "detect_leaks=0:alloc_dealloc_mismatch=0", 1);
  }
  ~Screen() {
    unsetenv("DISPLAY");
    unsetenv("ASAN_OPTIONS");
    server_.signal(SIGTERM);  // lets it remove its lock and its socket
    server_.wait();
  }

  /// Prefix for act() that sends keys, named as in `xdotool`, to the focused window (0) rather than to a given window:
  /// if a key closes the window, its release would go to that window, and the server would consider the key pressed and
  /// not report it to the next window.
  static std::string keys(const std::string& names) { return "windowfocus key --window 0 " + names; }
  /// Runs `xdotool` on RoboSim's window.
  void act(const std::string& what) const { runCommand("xdotool search --name RoboSim " + what); }

  cv::Mat shot(const std::filesystem::path& folder) const {
    const auto file = folder / "screen.png";
    runCommand("import -window root '" + file.string() + "'");
    return cv::imread(file.string());
  }

  /// Number of pixels that satisfy a predicate, as soon as it is at least `count`; the last number when the program has
  /// ended, or after a timeout.
  int waitForPixels(int count, const std::function<bool(const cv::Vec3b&)>& is_one, const std::filesystem::path& folder,
                    StartedProgram& program) const {
    int found = 0;
    for (int tries = 0; tries < 600 && found < count && program.isRunning(); ++tries) {
      const cv::Mat seen = shot(folder);
      found = 0;
      for (int y = 0; y < seen.rows; ++y) {
        for (int x = 0; x < seen.cols; ++x) found += is_one(seen.at<cv::Vec3b>(y, x)) ? 1 : 0;
      }
    }
    return found;
  }

 private:
  StartedProgram server_;
  std::string display_;
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
