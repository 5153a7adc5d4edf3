#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "recording/rawlog_writer.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"

namespace robosim {

/// Recordings of two robots.
class RecordedStepsTest : public TestFolder {
 protected:
  /// Records steps of two robots, with messages and commands.
  void record(std::size_t steps, RawlogFormat format = RawlogFormat::observations) {
    RawlogWriter writer(file_, robots_, format, RawlogImages::embedded, "first note");
    for (std::size_t step = 0; step < steps; ++step) {
      written_.push_back(readingsAt(step));
      truth_.push_back({mrpt::math::TPose2D(1, 0.1 * static_cast<double>(step), 0.25), mrpt::math::TPose2D(2, 3, -1)});
      commands_.push_back(
          {{0.1, 0.2, 0.5F, Activity::active, step == 3, step % 4 == 3}, {0.3, -0.4, 0, Activity::halted}});
      writer.write(written_.back(), truth_.back(), commands_.back());
    }
    writer.close("last note");
  }

  std::vector<Readings> readingsAt(std::size_t step) const {
    std::vector<Readings> readings{withoutPictures(sampleReadings(robots_[0], step)),
                                   withoutPictures(sampleReadings(robots_[1], step + 1000))};
    readings[1].time.step = step;
    readings[0].stalled = step % 3 == 0;
    readings[1].is_too_far = step == 7;
    if (step >= 40) readings[0].winner = readings[1].winner = "b";
    if (step % 4 == 1) readings[1].inbox.edit() = {{"a", "b", "GOLD"}, {"a", "b", std::string("\0\xff", 2)}};
    return readings;
  }
  /// Images are compressed again when they are read.
  Readings withoutPictures(Readings readings) const {
    for (auto& measurement : readings.measurements) {
      if (auto* image = std::get_if<Image>(&measurement)) *image = {};
    }
    return readings;
  }

  std::filesystem::path file_ = in("run.rawlog");
  std::vector<RobotInfo> robots_{sampleRobot("a"), sampleRobot("b")};
  std::vector<std::vector<Readings>> written_;
  std::vector<std::vector<mrpt::math::TPose2D>> truth_;
  std::vector<std::vector<Command>> commands_;
};

/// Why the next step cannot be read; "none" if it can.
inline std::string refusal(RecordedSteps& steps) {
  try {
    steps.next();
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace robosim
