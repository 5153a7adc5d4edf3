#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "arcos/protocol/laser_packets.h"
#include "environment/environment.h"

namespace robosim {

/// Measures the laser scans that ARCOS programs request, with any field of view and resolution. A request that the
/// laser of the robot type answers takes its readings, with their noise; others are measured without noise.
class ArcosLasers {
 public:
  /// @param environment must outlive this
  explicit ArcosLasers(Environment& environment);

  struct Request {
    std::uint32_t robot = 0;
    arcos::LaserRequest laser;           ///< with at least one beam
    std::vector<std::uint16_t>* ranges;  ///< receives the scan [mm]
  };
  /// Measures all requested scans in the present state. @param requests in ascending order of robots
  void measure(std::span<const Request> requests);

 private:
  /// A robot model and a request.
  using Key = std::tuple<const RobotModel*, int, int, int>;
  struct Group {
    std::shared_ptr<const Sensor> sensor;
    std::vector<std::uint32_t> robots;  ///< that request it in this step
    std::vector<std::vector<std::uint16_t>*> ranges;
  };
  Group& groupOf(const RobotModel& model, const arcos::LaserRequest& laser);

  Environment& environment_;
  std::map<Key, Group> groups_;
  std::vector<Readings> readings_;  ///< by robot: of the sensors in groups_
};

}  // namespace robosim
