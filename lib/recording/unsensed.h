#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/byte_archive.h"
#include "recording/imprint.h"

namespace robosim {

/// @name The label's second half for what no sensor of the robot measures
///@{
inline constexpr const char* kStatus = "STATUS";  ///< command, stalled, where the laser looked
inline constexpr const char* kInbox = "INBOX";    ///< messages of other robots
inline constexpr const char* kPoints = "POINTS";  ///< "<robot>/<sensor>/POINTS": where echoes came from
///@}

/// What no sensor measures, but a robot's program heard or said, so that a replay has it too. All are
/// CObservationRawDAQ, which stock tools carry along:
///
///  * STATUS, each step: analog outputs (double) are the command that the step was made with: speed [m/s], turn
///  [rad/s],
///    pan [rad], activity, and 1 when a person drives; analog inputs (double) are where the turnable sensors looked
///    [rad], then 1 for stalled, for having asked in vain whether it has won, and for having won;
///  * POINTS, where echoes of a sensor did not come from its beams' axes at the ranges told (a wide sonar's nearest
///    point, something nearer than the least range): analog inputs (float), x y z [m] of each echo, robot frame;
///  * INBOX, when there was mail: digital inputs are its bytes: of each message its sender and its text, each as a
///    32-bit length (least byte first) and so many bytes.
class Unsensed {
 public:
  explicit Unsensed(const RobotInfo& robot);
  Unsensed(const Unsensed&) = delete;
  Unsensed& operator=(const Unsensed&) = delete;

  /// What there is in this step. STATUS and POINTS are the same objects in every call, filled anew.
  std::vector<mrpt::obs::CObservation::Ptr> of(const Readings&, const Command&);
  /// Appends the bytes of all that of() gives.
  void write(const Readings&, const Command&, ByteArchive& archive);

 private:
  struct Axis {
    mrpt::math::TPoint3D origin, direction;
  };
  /// An observation that is filled anew in each step, with its bytes.
  struct Form {
    std::shared_ptr<mrpt::obs::CObservationRawDAQ> observation;
    std::optional<Imprint> imprint;
    void write(ByteArchive& archive);
  };
  void fillStatus(const Readings&, const Command&);
  /// Calls visit(form) for what there is of POINTS, filled.
  template <typename Visit>
  void forPoints(const Readings&, const Visit& visit);
  mrpt::obs::CObservation::Ptr inboxOf(const Readings&) const;
  bool isAlongAxes(std::size_t slot, const Echoes& echoes, double pan_rad) const;

  std::string robot_;
  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  std::vector<std::vector<Axis>> axes_;  ///< by sensor, of its beams, not panned
  Form status_;
  std::vector<Form> points_;  ///< by sensor
};

/// What STATUS tells.
struct RobotStatus {
  Command command;
  float laser_pan_rad = 0;
  bool stalled = false;
  bool is_too_far = false;
  bool has_won = false;
};

/// @name The way back
/// @throws RecordingError for an observation that no Unsensed wrote.
///@{
RobotStatus statusFrom(const mrpt::obs::CObservation&);
void takePoints(const mrpt::obs::CObservation&, Echoes&);
/// @param to the robot that the messages were for
std::vector<RobotMessage> inboxFrom(const mrpt::obs::CObservation&, const std::string& to);
///@}

}  // namespace robosim
