#include "tests/scenarios/screen.h"

#include <csignal>
#include <stdexcept>
#include <thread>

#include <opencv2/imgproc.hpp>
#include <xcb/xcb.h>

namespace robosim {

int pixelsBetween(const cv::Mat& picture, const cv::Scalar& low, const cv::Scalar& high) {
  cv::Mat are_between;
  cv::inRange(picture, low, high, are_between);
  return cv::countNonZero(are_between);
}

int bluesIn(const cv::Mat& picture) { return pixelsBetween(picture, {121, 0, 0}, {255, 255, 79}); }

int litsIn(const cv::Mat& picture) {
  return static_cast<int>(picture.total()) - pixelsBetween(picture, {0, 0, 0}, {0, 0, 0});
}

Screen::Screen()
    : server_("/usr/bin/Xvfb",
              {"-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset", "-r"}),
      connection_(nullptr, xcb_disconnect) {
  server_.waitForOutput("\n");
  const std::string display = ":" + server_.output().substr(0, server_.output().find('\n'));
  setenv("DISPLAY", display.c_str(), 1);
  // LeakSanitizer cannot name leaks of window system libraries that have been unloaded. Programs without a window are
  // still checked for leaks.
  // MRPT's nanogui deallocates widgets with another operator delete than programs of C++17 and later require.
  setenv("ASAN_OPTIONS", "detect_leaks=0:alloc_dealloc_mismatch=0", 1);
  connection_.reset(xcb_connect(display.c_str(), nullptr));
  if (xcb_connection_has_error(connection_.get()) != 0) throw std::runtime_error("no connection to Xvfb " + display);
}

Screen::~Screen() {
  connection_.reset();
  unsetenv("DISPLAY");
  unsetenv("ASAN_OPTIONS");
  server_.signal(SIGTERM);  // lets it remove its lock and its socket
  server_.wait();
}

cv::Mat Screen::shot() const {
  auto* const connection = connection_.get();
  const xcb_screen_t* const screen = xcb_setup_roots_iterator(xcb_get_setup(connection)).data;
  const auto request = xcb_get_image(connection, XCB_IMAGE_FORMAT_Z_PIXMAP, screen->root, 0, 0, screen->width_in_pixels,
                                     screen->height_in_pixels, ~0U);
  const std::unique_ptr<xcb_get_image_reply_t, void (*)(void*)> reply(xcb_get_image_reply(connection, request, nullptr),
                                                                      std::free);
  if (!reply) throw std::runtime_error("Xvfb gives no picture of its screen");
  const cv::Mat bgrx(screen->height_in_pixels, screen->width_in_pixels, CV_8UC4, xcb_get_image_data(reply.get()));
  cv::Mat bgr;
  cv::cvtColor(bgrx, bgr, cv::COLOR_BGRA2BGR);
  return bgr;
}

cv::Mat Screen::waitFor(const std::function<bool(const cv::Mat& screen)>& is_it, StartedProgram& program) const {
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  while (true) {
    const bool is_last = !program.isRunning() || std::chrono::steady_clock::now() > end;
    cv::Mat seen = shot();
    if (is_last || is_it(seen)) return seen;
    // Leaves the processor to the program and the server.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

int Screen::waitForPixels(int count, const std::function<int(const cv::Mat& screen)>& pixels_in,
                          StartedProgram& program) const {
  int found = 0;
  waitFor([&](const cv::Mat& seen) { return (found = pixels_in(seen)) >= count; }, program);
  return found;
}

}  // namespace robosim
