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

/// A scan that ArcosLasers has measured.
struct ArcosScan {
  std::vector<std::uint16_t> ranges_mm;
  std::vector<std::uint8_t> reflectance;  ///< empty in a world without reflectors
  arcos::Scan view() const { return {ranges_mm, reflectance}; }
};

/// Measures the laser scans that ARCOS programs request, with any field of view and resolution. A request that the
/// laser of the robot type answers takes its readings, with their noise; others are measured without noise. The n-th
/// laser of a program is the n-th of the robot type; a type without a laser has the first one.
///
/// Objects that return at least kReflectorReturn of a laser's light are reflectors.
class ArcosLasers {
 public:
  /// @param environment must outlive this
  explicit ArcosLasers(Environment& environment);

  struct Request {
    std::uint32_t robot = 0;
    std::size_t number = 0;     ///< of the laser
    arcos::LaserRequest laser;  ///< with at least one beam, of a laser that the robot has
    ArcosScan* scan;            ///< receives the scan
  };
  static constexpr double kReflectorReturn = 0.9;

  /// Whether a robot has a laser of this number.
  static bool has(const RobotModel& model, std::size_t number);
  /// Measures all requested scans in the present state. @param requests in ascending order of robots
  void measure(std::span<const Request> requests);

 private:
  /// A robot model, the number of a laser, and a request.
  using Key = std::tuple<const RobotModel*, std::size_t, int, int, int>;
  struct Group {
    std::shared_ptr<const Sensor> sensor, reflectance;
    std::vector<std::uint32_t> robots;    ///< that request it in this step
    std::vector<std::uint32_t> measured;  ///< of them, those that have measured it themselves
    std::vector<ArcosScan*> scans;
  };
  Group& groupOf(const RobotModel& model, const Request& request);
  bool hasReflectors() const;
  /// Measures by a sensor for robots, in readings_.
  void measure(const Sensor& sensor, const std::vector<std::uint32_t>& robots);

  Environment& environment_;
  std::map<Key, Group> groups_;
  std::vector<Readings> readings_;  ///< by robot: of the sensors in groups_
};

}  // namespace robosim
