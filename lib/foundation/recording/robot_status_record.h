#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "base/label.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/byte_archive.h"
#include "recording/serialized_template.h"

namespace robosim {

/// Converts the data of a robot that no sensor measures to observations, so that a replay is complete. All are
/// CObservationRawDAQ, which stock tools preserve:
///
///  * STATUS, in each step: analog outputs (double) are the executed command: speed [m/s], turn [rad/s], pan [rad],
///    activity, and the sum of 1 when a person drives and 2 for an emergency stop; of an omnidirectional robot the
///    lateral speed [m/s]; of a robot with a camera's head pan [rad], tilt [rad], zoom and the speeds of pan and tilt
///    [rad/s]; analog inputs (double) are the pan angle of the panning sensors [rad], then 1 for stalled, for a refused
///    CheckWin, and for having won;
///  * POINTS, for a sensor with echoes off its beams' axes or not at the reported ranges (the nearest point in a wide
///    sonar cone, an object nearer than the minimum range), in steps with an observation of it: analog inputs (float),
///    x y z [m] of each echo, robot frame;
///  * INBOX, in steps with received messages: digital inputs are bytes: sender and text of each message, each as a
///    32-bit length (little-endian) and its bytes.
class RobotStatusRecord {
 public:
  explicit RobotStatusRecord(const RobotInfo& robot);
  RobotStatusRecord(const RobotStatusRecord&) = delete;
  RobotStatusRecord& operator=(const RobotStatusRecord&) = delete;

  /// The observations of this step. The objects of STATUS and POINTS are reused by the next call.
  /// @param kept RobotObservations::kept(); of no sensor beyond its end
  std::vector<mrpt::obs::CObservation::Ptr> of(const Readings&, const Command&,
                                               std::span<const std::uint8_t> kept = {});
  /// Serialises the observations of of().
  void write(const Readings&, const Command&, ByteArchive& archive, std::span<const std::uint8_t> kept = {});

  /// Whether write() writes STATUS by its template; otherwise MRPT writes the same bytes, with three times the
  /// instructions.
  bool hasStatusTemplate() const { return status_.serialized.has_value(); }

 private:
  struct Axis {
    mrpt::math::TPoint3D origin, direction;
  };
  /// A reused observation and the template of its serialised form.
  struct TemplatedObservation {
    std::shared_ptr<mrpt::obs::CObservationRawDAQ> observation;
    std::optional<SerializedTemplate> serialized;
    void write(ByteArchive& archive);
  };
  void fillStatus(const Readings&, const Command&);
  /// Calls visit(TemplatedObservation) for the POINTS of this step.
  template <typename Visit>
  void forPoints(const Readings&, std::span<const std::uint8_t> kept, const Visit& visit);
  mrpt::obs::CObservation::Ptr inboxOf(const Readings&) const;
  bool isAlongAxes(std::size_t slot, const Echoes& echoes, double pan_rad) const;

  std::string robot_;
  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  bool has_camera_head_ = false;
  std::vector<std::vector<Axis>> axes_;  ///< of the beams, by sensor, for a pan angle of 0
  TemplatedObservation status_;
  std::vector<TemplatedObservation> points_;  ///< by sensor
};

/// Content of STATUS.
struct RobotStatus {
  Command command;
  bool has_camera_head = false;  ///< the robot
  float laser_pan_rad = 0;
  bool stalled = false;
  bool is_too_far = false;
  bool has_won = false;
};

/// @name Inverse conversions
/// @throws RecordingError for an observation that no RobotStatusRecord wrote.
///@{
RobotStatus statusFrom(const mrpt::obs::CObservation&);
/// Replaces the points of echoes.
void restorePoints(const mrpt::obs::CObservation&, Echoes&);
/// @param to the receiver of the messages
std::vector<RobotMessage> inboxFrom(const mrpt::obs::CObservation&, const std::string& to);
///@}

}  // namespace robosim
