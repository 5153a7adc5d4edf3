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

#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/byte_archive.h"
#include "recording/imprint.h"
#include "recording/picture_folder.h"

namespace robosim {

class JpegObservation;

/// What simulated time 0 is called in a recording: 2005-01-01 00:00:00 UTC, in seconds since 1970. Fixed, so that the
/// same run is the same recording.
constexpr std::int64_t kEpochUnixSeconds = 1'104'537'600;

/// Simulated time as MRPT's timestamp (its unit is 100 ns).
mrpt::Clock::time_point timestampOf(const SimTime&);
/// Simulated time [s] since the start of the run.
double secondsSinceStart(mrpt::Clock::time_point);

/// The rawlog's label of a sensor: "<robot>/<sensor>".
std::string sensorLabel(const std::string& robot, const std::string& sensor);
/// The label's second half for where a robot really was.
inline constexpr const char* kGroundTruth = "GROUND_TRUTH";

/// One robot's readings as stock MRPT observations (the table is in doc/rawlog.md):
///
///  * laser with two or more evenly spaced beams from one place: CObservation2DRangeScan; no echo is an invalid range
///  * sonar, infrared, any other laser: CObservationRange, one for all beams; `sensorID` counts them. No echo is
///    recordedNoEcho(), a little more than the sensor's maximum: MRPT's maps leave out what lies beyond the maximum,
///    but not all of them leave out 0
///  * heat: CObservationGasSensors, one e-nose with only a temperature, in single precision
///  * bumper: CObservationRawDAQ, segment i is digital input i (bit i % 8 of byte i / 8)
///  * compass: CObservationIMU with only a yaw
///  * battery: CObservationBatteryState with the main battery's voltage
///  * odometry: CObservationOdometry. Stock icp-slam makes NaN of an angular speed of exactly 0, so 0 is written as
///    kNoTurn_radps
///  * camera: CObservationImage, the JPEG file's very bytes, embedded or in a file of its own
///  * blob finder: CObservationRawDAQ, seven double-precision analogue inputs for each colour: pixels, x, y, left, top,
///    width, height
///  * ground truth: CObservationRobotPose
///
/// A step in which a camera takes no picture has no observation of it, nor of its blob finder.
/// A sensor that turns is recorded with the pose that it had. measurementFrom() (measurements.h) is the way back.
class RobotObservations {
 public:
  /// @param pictures where cameras' pictures go as files of their own, as of() or write() gets them; must outlive this.
  ///        Null: they are embedded
  explicit RobotObservations(const RobotInfo& robot, PictureFolder* pictures = nullptr);
  RobotObservations(const RobotObservations&) = delete;
  RobotObservations& operator=(const RobotObservations&) = delete;

  /// Ground truth if it is given, odometry, then the other sensors that measured anything, as the robot lists them. The
  /// same objects are filled anew in every call: serialise them, or copy what is to stay.
  std::span<const mrpt::obs::CObservation::Ptr> of(const Readings&,
                                                   const std::optional<mrpt::math::TPose2D>& world_from_robot);

  /// Appends the bytes of all that of() gives, some three times as fast as `archive << observation` for each.
  void write(const Readings&, const std::optional<mrpt::math::TPose2D>& world_from_robot, ByteArchive& archive);

 private:
  void putAway(JpegObservation& picture, const std::string& stem, const SimTime& time);
  void tellTruth(const mrpt::math::TPose2D& world_from_robot, mrpt::Clock::time_point timestamp);
  void makeImprints();
  std::vector<Imprint::Number> changingNumbers(std::size_t i);

  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  std::vector<std::size_t> slots_;  ///< of observations_[1 + i]: its place in RobotInfo::sensors
  std::vector<mrpt::obs::CObservation::Ptr> observations_;  ///< ground truth, and one per sensor
  PictureFolder* pictures_;
  std::vector<std::string> stems_;                   ///< of the names of a camera's files; as observations_
  std::vector<std::size_t> told_;                    ///< which of them this step has
  std::vector<mrpt::obs::CObservation::Ptr> given_;  ///< these
  std::vector<std::optional<Imprint>> imprints_;     ///< as observations_; of sensors that turn, not turned
  std::array<double, 12> truth_{};                   ///< ground truth as MRPT writes it: x, y, z, 3 × 3 rotation
};

/// What CObservationRange holds for a beam of this sensor that met nothing [m].
float recordedNoEcho(const SensorInfo&);

/// Written for an angular speed of exactly 0.
constexpr double kNoTurn_radps = 1e-6;

}  // namespace robosim
