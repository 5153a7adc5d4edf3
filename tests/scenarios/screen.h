#pragma once
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "tests/scenarios/program.h"

namespace robosim {

/// An X server without a screen, and what one sees on it. It does not begin anew when the last program leaves, which
/// would turn away the next, nor does it repeat keys that a slow machine is late to release.
class Screen {
 public:
  Screen()
      : server_("/usr/bin/Xvfb",
                {"-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset", "-r"}) {
    server_.waitForOutput("\n");
    display_ = ":" + server_.output().substr(0, server_.output().find('\n'));
    setenv("DISPLAY", display_.c_str(), 1);
    // What libraries of the window system leave behind when they are unloaded, nobody can tell apart by name. Programs
    // without a window are searched for leaks as ever.
    // And MRPT's nanogui frees its widgets by another way than a program of C++17 and later makes them.
    setenv("ASAN_OPTIONS", "detect_leaks=0:alloc_dealloc_mismatch=0", 1);
  }
  ~Screen() {
    unsetenv("DISPLAY");
    unsetenv("ASAN_OPTIONS");
    server_.signal(SIGTERM);  // so that it takes its lock and its socket away
    server_.wait();
  }

  /// What has act() press keys, as `xdotool` names them, where the focus is (window 0) rather than in a window it is
  /// told of: when a key closes the window, its release would be sent to that, and the server would hold it for pressed
  /// and, as nothing is repeated, not pass it on to the next window.
  static std::string keys(const std::string& names) { return "windowfocus key --window 0 " + names; }
  /// Has `xdotool` do something in RoboSim's window.
  void act(const std::string& what) const { runCommand("xdotool search --name RoboSim " + what); }

  cv::Mat shot(const std::filesystem::path& folder) const {
    const auto file = folder / "screen.png";
    runCommand("import -window root '" + file.string() + "'");
    return cv::imread(file.string());
  }

  /// How many pixels are of a kind, as soon as there are so many; or whatever there are when the program has ended, or
  /// after a long time.
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

/// Opens a file in one of MRPT's programs that have a window. Mesa's drawing by the processor is right for them only
/// without what is newer than SSE 4.1.
inline StartedProgram startStockWindow(const std::string& program, const std::filesystem::path& file) {
  return StartedProgram("/usr/bin/env", {"HOME=" + file.parent_path().string(), "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
                                         program, file.string()});
}

}  // namespace robosim
