#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <thread>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "rendering/picture_format.h"
#include "rendering/png_file.h"
#include "viewing/video_file.h"
#include "viewing/view_outputs.h"

namespace robosim {
namespace {

/// Skips gaps of a recording, which a video omits.
class LeftOut {
 public:
  void add(double from_s, double to_s) {
    if (count_++ == 0) first_s_ = from_s;
    total_s_ += to_s - from_s;
  }
  void print() const {
    if (count_ == 0) return;
    logWarning("view", "nothing was recorded for " + fixed(total_s_, 1) + " s, in " +
                           (count_ == 1 ? "a gap" : withCommas(count_) + " gaps, the first") + " at " +
                           fixed(first_s_, 1) + " s; omitted from the video");
  }

 private:
  std::uint64_t count_ = 0;
  double first_s_ = 0, total_s_ = 0;
};

[[noreturn]] void throwInterrupted() { throw Interrupted("interrupted; nothing was written"); }

/// End of a recording, or of its selected part.
double computeEnd(double duration_s, const ViewTimes& times) {
  return std::min(times.to_s.value_or(duration_s), duration_s);
}

void writePicture(ViewSource& source, ViewDrawing& drawing, Size size, const ViewTimes& times,
                  const std::string& file) {
  showPictureTime(source, times);
  writePngFile(file, drawing.draw(size));
}

void writeVideo(ViewSource& source, ViewDrawing& drawing, Size size, const ViewTimes& times, const std::string& file) {
  const Interrupt interrupt;
  Progress progress;
  const auto start = Progress::Clock::now();
  VideoFile video(file, size.width_px, size.height_px, times.fps);
  if (const auto duration_s = source.duration()) {
    double end_s = computeEnd(*duration_s, times);
    const double speed = times.speed.value_or(1);
    // Rounding errors of times, which are as large as 10⁹ s in recordings with a wrong clock.
    const double rounding_s = 1e-9 + 4 * std::numeric_limits<double>::epsilon() * end_s;
    LeftOut left_out;
    source.pause(true);
    double begin_s = times.from_s.value_or(0);
    std::uint64_t frame = 0;  // since then
    for (double t = begin_s;;) {
      if (interrupt.isRequested()) throwInterrupted();
      source.seek(t);
      source.advance(0);
      end_s = computeEnd(source.duration().value_or(end_s), times);  // earlier after damage
      video.add(drawing.draw(size));
      if (progress.due()) {
        const double elapsed_s = secondsSince(start);
        progress.show(fixed(t, 1) + " of " + fixed(end_s, 1) + " s" +
                      commaRemainingTime(elapsed_s, t - begin_s, end_s - begin_s));
      }
      if (t >= end_s - rounding_s) break;
      // The last frame shows the end, also when it is less than a period after the frame before.
      t = std::min(begin_s + static_cast<double>(++frame) * speed / times.fps, end_s);
      if (const double past_s = source.pastGap(t, speed); past_s > t) {
        left_out.add(t, std::min(past_s, end_s));
        if (past_s > end_s + rounding_s) break;
        t = begin_s = past_s;
        frame = 0;
      }
    }
    left_out.print();
  } else {
    // Live run: draws the latest snapshot whenever a frame is due.
    using Clock = std::chrono::steady_clock;
    const auto first = Clock::now();
    for (std::uint64_t frame = 0;; ++frame) {
      const double due_s = static_cast<double>(frame) / times.fps;
      std::this_thread::sleep_until(first + fromSeconds(due_s));
      if (interrupt.isRequested() || (times.for_s && due_s > *times.for_s)) break;
      source.advance(1 / times.fps);
      video.add(drawing.draw(size));
      if (source.isOver()) break;
      if (progress.due()) progress.show(fixed(due_s, 1) + " s …");
    }
  }
  video.commit();
}

}  // namespace

bool isFigure(const std::string& file) {
  const auto format = recognizePictureFormat(file);
  return format && *format != PictureFormat::png;
}

void checkOffscreenFile(const std::string& file) {
  if (!isVideo(file) && !recognizePictureFormat(file)) {
    throw ConfigError(
        "--offscreen " + file +
        ": must end in .png, for a picture, in .svg or .pdf, for a figure, or in .mp4, .webm or .webp, for a "
        "video");
  }
  checkWritable(file);
}

void showPictureTime(ViewSource& source, const ViewTimes& times) {
  if (const auto duration_s = source.duration()) {
    source.pause(true);
    source.seek(computeEnd(*duration_s, times));
  }
  source.advance(0);
}

void writeOffscreen(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                    const std::string& file, const Panes::Look& look, const ViewLayers& layers,
                    const RobotSelection& only) {
  if (isVideo(file) && source.isOver() && !source.duration()) {
    throw ConfigError("--offscreen " + file +
                      ": nothing moves in a world that does not run; ask for a .png, or record a run");
  }
  ViewDrawing drawing(source, make_panes, layers, only);
  drawing.panes().look() = look;
  drawing.panes().layers().paths_from_s = times.from_s.value_or(0);
  if (isVideo(file)) {
    writeVideo(source, drawing, size, times, file);
  } else {
    writePicture(source, drawing, size, times, file);
  }
  std::cout << printableText(file) << '\n';
  if (const auto remark = source.remark(); !remark.empty()) logWarning("view", remark);
}

}  // namespace robosim
