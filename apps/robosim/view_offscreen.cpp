#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "base/error_list.h"
#include "base/whole_file.h"
#include "rendering/png_file.h"
#include "robosim/interrupt.h"
#include "robosim/progress.h"
#include "robosim/text.h"
#include "robosim/view_outputs.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Grows under another name, and has its own when it is whole.
class Video {
 public:
  Video(const fs::path& file, Size size, double fps) : file_(file), part_(file.string() + ".part.mp4") {
    // What is wrong, we tell.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    writer_.open(part_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), fps,
                 {size.width_px & ~1, size.height_px & ~1});
    if (!writer_.isOpened()) {
      throw ConfigError(part_.string() +
                        ": no video can be written there; is the folder writable, and is the package "
                        "libopencv-videoio installed with FFmpeg?");
    }
  }
  ~Video() {
    writer_.release();
    std::error_code ignored;
    fs::remove(part_, ignored);
  }
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const cv::Mat& picture) {
    // Video is made of blocks: sides are even.
    writer_.write(picture(cv::Rect(0, 0, picture.cols & ~1, picture.rows & ~1)));
  }
  void commit() {
    writer_.release();
    std::error_code error;
    fs::rename(part_, file_, error);
    if (error) {
      throw std::runtime_error(file_.string() + ": cannot be written (" + error.message() + "); choose another place");
    }
  }

 private:
  fs::path file_, part_;
  cv::VideoWriter writer_;
};

/// Gaps of a recording that a video has not.
class LeftOut {
 public:
  void add(double from_s, double to_s) {
    if (count_++ == 0) first_s_ = from_s;
    total_s_ += to_s - from_s;
  }
  void tell() const {
    if (count_ == 0) return;
    std::cerr << "robosim view: nothing was recorded for " << fixed(total_s_, 1) << " s, in "
              << (count_ == 1 ? "a gap" : withCommas(count_) + " gaps, the first") << " at " << fixed(first_s_, 1)
              << " s; the video leaves that out\n";
  }

 private:
  std::uint64_t count_ = 0;
  double first_s_ = 0, total_s_ = 0;
};

[[noreturn]] void throwInterrupted() { throw std::runtime_error("interrupted; nothing was written"); }

/// Where a recording, or the part of it that is wanted, ends.
double endOf(double duration_s, const ViewTimes& times) {
  return std::min(times.to_s.value_or(duration_s), duration_s);
}

void writePicture(ViewSource& source, ViewDrawing& drawing, Size size, const ViewTimes& times,
                  const std::string& file) {
  if (const auto duration_s = source.duration()) {
    // Through what came before, so that there are trails: from moment to moment, however far they lie apart.
    const Interrupt interrupt;
    Progress progress;
    const double end_s = endOf(*duration_s, times);
    source.pause(true);
    source.seek(times.from_s.value_or(0));
    source.advance(0);
    while (source.shown().time_s < end_s && !source.isOver()) {
      if (interrupt.asked()) throwInterrupted();
      drawing.note();
      if (progress.due()) progress.show(fixed(source.shown().time_s, 1) + " of " + fixed(end_s, 1) + " s …");
      source.step();
      source.advance(0);
    }
    source.seek(end_s);
  }
  source.advance(0);
  writePngFile(file, drawing.draw(size));
}

void writeVideo(ViewSource& source, ViewDrawing& drawing, Size size, const ViewTimes& times, const std::string& file) {
  const Interrupt interrupt;
  Progress progress;
  Video video(file, size, times.fps);
  if (const auto duration_s = source.duration()) {
    const double end_s = endOf(*duration_s, times);
    const double speed = times.speed.value_or(1);
    LeftOut left_out;
    source.pause(true);
    double begin_s = times.from_s.value_or(0);
    std::uint64_t frame = 0;  // since then
    for (double t = begin_s; t <= end_s + 1e-9;) {
      if (interrupt.asked()) throwInterrupted();
      source.seek(t);
      source.advance(0);
      video.add(drawing.draw(size));
      if (progress.due()) progress.show(fixed(t, 1) + " of " + fixed(end_s, 1) + " s …");
      t = begin_s + static_cast<double>(++frame) * speed / times.fps;
      if (const double past_s = source.pastGap(t, speed); past_s > t) {
        left_out.add(t, std::min(past_s, end_s));
        t = begin_s = past_s;
        frame = 0;
      }
    }
    left_out.tell();
  } else {
    // A run that goes on: what it shows whenever a picture is due.
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (std::uint64_t frame = 0;; ++frame) {
      const std::chrono::duration<double> due(static_cast<double>(frame) / times.fps);
      std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(due));
      if (interrupt.asked() || (times.for_s && due.count() > *times.for_s)) break;
      source.advance(1 / times.fps);
      video.add(drawing.draw(size));
      if (source.isOver()) break;
      if (progress.due()) progress.show(fixed(due.count(), 1) + " s …");
    }
  }
  video.commit();
}

}  // namespace

bool isVideo(const std::string& file) { return fs::path(file).extension() == ".mp4"; }

void checkOffscreenFile(const std::string& file) {
  if (!isVideo(file) && fs::path(file).extension() != ".png") {
    throw ConfigError("--offscreen " + file + ": must end in .png, for a picture, or .mp4, for a video");
  }
  checkWritable(file);
}

void writeOffscreen(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                    const std::string& file) {
  if (isVideo(file) && source.isOver() && !source.duration()) {
    throw ConfigError("--offscreen " + file +
                      ": nothing moves in a world that does not run; ask for a .png, or record a run");
  }
  ViewDrawing drawing(source, make_panes);
  if (isVideo(file)) {
    writeVideo(source, drawing, size, times, file);
  } else {
    writePicture(source, drawing, size, times, file);
  }
  std::cout << file << '\n';
  if (const auto remark = source.remark(); !remark.empty()) std::cerr << "robosim view: " << remark << '\n';
}

}  // namespace robosim
