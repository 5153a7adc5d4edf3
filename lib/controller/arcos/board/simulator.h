#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "arcos/protocol/simulator_packets.h"

namespace robosim {

/// What an ARCOS program may request of the simulator of its robot, as opposed to the robot.
class Simulator {
 public:
  virtual ~Simulator() = default;
  virtual arcos::SimStat stat() const = 0;
  virtual std::string mapFile() const = 0;  ///< in use
  virtual void setTruePose(const arcos::SimPose& pose) = 0;
  virtual void resetTruePose() = 0;  ///< to the start
  /// The scan that the session's LaserRequest describes, measured in this step [mm].
  virtual std::span<const std::uint16_t> scan() const = 0;
  virtual void log(const std::string& text) = 0;
};

}  // namespace robosim
