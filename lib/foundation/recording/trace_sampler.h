#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "recording/member_index.h"

namespace robosim {

/// Selects the points of the robots' paths for the index of a recording, by which a view draws them without reading the
/// steps. A robot has a point at the latest when it is kMaxSpacing_m from its last one or has turned by kMaxTurn_rad
/// since, and whenever it appears, disappears, stalls, continues, finds gold, or a message that it has sent is
/// received.
///
/// The path between two points is thus within kMaxSpacing_m of the first one, as where a robot drives forward and back,
/// and within kMaxSpacing_m * kMaxTurn_rad / 8 of the straight line for a robot that drives in the direction that it
/// faces.
class TraceSampler {
 public:
  static constexpr double kMaxSpacing_m = 0.25, kMaxTurn_rad = 0.1;
  /// Points closer to each other do not differ in a picture.
  static constexpr double kMinSpacing_m = 0.02;

  /// Adds a robot with the next index.
  void addRobot(const std::string& name);
  std::size_t robots() const { return last_.size(); }

  /// Appends the points of a step.
  /// @param step after the first one of the member
  /// @param world_from_robot, commands by robot; commands may be empty
  void add(std::uint32_t step, const std::vector<Readings>& readings,
           const std::vector<mrpt::math::TPose2D>& world_from_robot, const std::vector<Command>& commands,
           std::vector<TracePoint>& points);

 private:
  struct Last {
    mrpt::math::TPose2D pose;
    std::uint8_t state = 0;  ///< its flags except TracePoint::sent
    bool is_any = false;
  };

  std::map<std::string, std::size_t> index_of_;
  std::vector<std::string> names_;
  std::vector<Last> last_;           ///< point of each robot
  std::vector<std::uint8_t> flags_;  ///< of each robot, in this step
};

}  // namespace robosim
