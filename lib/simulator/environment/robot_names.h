#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robots/fleet.h"

namespace robosim {

/// The names of the robots of a fleet, which keeps them, and the robots by their names.
class RobotNames {
 public:
  /// @param robots must outlive this object
  explicit RobotNames(std::span<const FleetRobot> robots) { setRobots(robots); }
  void setRobots(std::span<const FleetRobot> robots);

  std::size_t size() const { return robots_.size(); }
  const std::string& operator[](std::size_t robot) const { return robots_[robot].info.name; }
  /// The robot of a name; nullopt for none.
  std::optional<std::uint32_t> find(const std::string& name) const;
  /// All of them, in the world's order. Made by the first call, because few runs need it. Thread-safe.
  const std::vector<std::string>& list() const;

 private:
  std::span<const FleetRobot> robots_;
  std::vector<std::uint32_t> by_name_;  ///< indices of robots, sorted by name
  mutable std::mutex making_list_;
  mutable std::atomic<bool> has_list_;
  mutable std::vector<std::string> list_;
};

}  // namespace robosim
