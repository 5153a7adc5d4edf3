#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include "base/label.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/byte_archive.h"
#include "recording/kept_readings.h"
#include "recording/picture_folder.h"
#include "recording/serialized_template.h"

namespace robosim {

class Codec;
class JpegObservation;

/// Timestamp of simulated time 0 in a recording: 2005-01-01 00:00:00 UTC, in seconds since 1970. Constant, so that
/// equal runs yield equal recordings.
constexpr std::int64_t kEpochUnixSeconds = 1'104'537'600;

/// Simulated time as MRPT's timestamp (its unit is 100 ns).
mrpt::Clock::time_point toTimestamp(const SimTime&);
/// Simulated time [s] since the start of the run.
double secondsSinceStart(mrpt::Clock::time_point);

/// Converts one robot's readings to stock MRPT observations, by the Codec of each sensor (codecs.h; table in
/// doc/rawlog.md), and ground truth to CObservationRobotPose. A step in which a camera takes no image has no
/// observation of the camera or its blob finder, and a step in which another sensor keeps its reading, because it does
/// not measure (SensorInfo::times), none of this sensor. A reading that differs from the one before, which is that of
/// blankMeasurement() at first, always has an observation. measurementFrom() (measurements.h) is the inverse.
class RobotObservations {
 public:
  /// @param pictures folder to which of() and write() save cameras' images; must outlive this. Null: images are
  /// embedded
  explicit RobotObservations(const RobotInfo& robot, PictureFolder* pictures = nullptr);
  RobotObservations(const RobotObservations&) = delete;
  RobotObservations& operator=(const RobotObservations&) = delete;

  /// Ground truth if given, odometry, then the other sensors that measured something, in the robot's order. The objects
  /// are reused by the next call.
  std::span<const mrpt::obs::CObservation::Ptr> of(const Readings&,
                                                   const std::optional<mrpt::math::TPose2D>& world_from_robot);

  /// Serialises the observations of of(), about three times as fast as `archive << observation` for each.
  void write(const Readings&, const std::optional<mrpt::math::TPose2D>& world_from_robot, ByteArchive& archive);

  /// By sensor: whether it had no observation in the last of() or write(), because it keeps its reading.
  const std::vector<std::uint8_t>& kept() const { return kept_; }
  /// Forgets the readings of the step before, of a robot that is absent.
  void forget();

 private:
  void saveExternally(JpegObservation& picture, const std::string& stem, const SimTime& time);
  void fillGroundTruth(const mrpt::math::TPose2D& world_from_robot, mrpt::Clock::time_point timestamp);
  void makeTemplates();
  std::vector<SerializedTemplate::Number> changingNumbers(std::size_t i);

  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  std::vector<const Codec*> codecs_;                        ///< of observations_[1 + i]
  std::vector<std::size_t> slots_;                          ///< index in RobotInfo::sensors of observations_[1 + i]
  std::vector<mrpt::obs::CObservation::Ptr> observations_;  ///< ground truth, and one per sensor
  PictureFolder* pictures_;
  std::vector<std::string> stems_;  ///< prefixes of a camera's file names; indexed as observations_
  KeptReadings readings_before_;
  std::vector<std::uint8_t> kept_;                            ///< by sensor
  std::vector<std::size_t> present_;                          ///< indices of the observations of this step
  std::vector<mrpt::obs::CObservation::Ptr> result_;          ///< the observations of this step
  std::vector<std::optional<SerializedTemplate>> templates_;  ///< indexed as observations_; for a pan angle of 0
  std::array<double, 12> ground_truth_{};                     ///< as MRPT writes it: x, y, z, 3 × 3 rotation
};

}  // namespace robosim
