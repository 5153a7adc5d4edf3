#include <iostream>
#include <set>

#include <mrpt/core/Clock.h>
#include <mrpt/core/format.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "recording/rawlog_reader.h"
#include "replay/replay.h"
#include "replay/selection.h"

namespace robosim {
namespace {

/// "time x y z yaw pitch roll"
std::string poseLine(double time_s, const mrpt::poses::CPose3D& pose) {
  return mrpt::format("%.7f %.9f %.9f %.9f %.9f %.9f %.9f\n", time_s, pose.x(), pose.y(), pose.z(), pose.yaw(),
                      pose.pitch(), pose.roll());
}

}  // namespace

ReplayResult writeGroundTruth(const ReplayArguments& arguments) {
  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads);
  AtomicFile file(arguments.ground_truth);
  Selection selection(arguments);
  Progress progress;
  std::set<std::string> robots;
  std::uint64_t poses = 0;
  while (const auto observation = reader.next()) {
    if (interrupt.isRequested()) throw Interrupted("interrupted; nothing was written");
    const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get());
    if (!truth || !selection.takes(*observation, reader)) continue;
    robots.insert(Label::parse(truth->sensorLabel).robot);
    if (robots.size() > 1) {
      throw ConfigError("--ground-truth: the recording has the true poses of several robots, such as " +
                        printableText(*robots.begin()) + " and " + printableText(*robots.rbegin()) +
                        "; select one with --robot NAME");
    }
    const double time_s = mrpt::Clock::toDouble(truth->timestamp);
    // pf-localization interprets the times as numbers of entries if one of the first two is a whole number. Therefore
    // the first pose is written two more times, with slightly earlier times.
    if (poses++ == 0) {
      for (const double earlier_s : {2e-4, 1e-4}) file.write(poseLine(time_s - earlier_s, truth->pose.mean));
    }
    file.write(poseLine(time_s, truth->pose.mean));
    if (progress.due()) progress.show(withCommas(poses) + " poses …");
  }
  if (poses == 0) {
    throw ConfigError(arguments.rawlog +
                      ": has no ground truth for the selection, which RoboSim records as "
                      "CObservationRobotPose; check --robot, --from and --to");
  }
  file.commit();
  std::cout << arguments.ground_truth << ": " << withCommas(poses) << " poses of " << printableText(*robots.begin())
            << '\n';
  warnOf(reader);
  return resultOf(reader);
}

}  // namespace robosim
