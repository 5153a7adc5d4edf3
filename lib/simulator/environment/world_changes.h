#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "robots/world_source.h"
#include "sensors/added_noise.h"
#include "world/world.h"

namespace robosim {

/// A robot to add to a world.
struct AddedRobot {
  std::string model;
  /// Start [m, rad]; nullopt: the home of a map, or the free place nearest to it; in a world with robots, also those
  /// added before, beside or behind one of them (findStartBeside()).
  std::optional<mrpt::math::TPose2D> world_from_robot;
  std::string name = {};  ///< empty: Robot1, Robot2, … as far as these names are free

  /// Parses `TYPE@X,Y,HEADING` in metres and degrees; HEADING is optional, default 0.
  /// @throws ConfigError
  static AddedRobot parse(const std::string& text);
};

/// Errors of the radio that WorldChanges::adds_radio_errors adds (doc/fidelity.md).
inline constexpr Communication kAddedRadio{
    .range_m = 100, .loss_probability = 0.01, .wall_range_m = 5, .burst_gap_s = 10, .burst_s = 0.5, .delay_s = 0.1};

/// Changes that a run makes to a world.
struct WorldChanges {
  std::vector<AddedRobot> robots;
  int random_robots = 0;  ///< number of robots to add at random positions, linked as neighbours in a ring
  std::string random_model = "pioneer3dx";
  /// Replaces the robots by so many of the first one's kind, at random free places, named Robot1, Robot2, …, each with
  /// the next as its neighbour, the last with the first; at least 1.
  std::optional<int> team;
  std::optional<double> message_loss;      ///< instead of Communication::loss_probability, [0, 1]
  bool has_random_starts = false;          ///< shuffleStartPoses()
  std::optional<double> start_distance_m;  ///< instead of World::start_distance_m, at least 0
  AddedNoise noise = AddedNoise::none;     ///< added to every sensor that supports noise and has none
  bool adds_radio_errors = false;          ///< kAddedRadio, unless the world specifies its communication

  bool addsRobots() const { return !robots.empty() || random_robots > 0; }
  bool isNone() const {
    return !addsRobots() && !team && !message_loss && !has_random_starts && !start_distance_m &&
           noise == AddedNoise::none && !adds_radio_errors;
  }
};

/// The world with these changes applied, as text, so that another process can build the same run. Added robots replace
/// the robot at the start pose of a bare map.
/// @param seed determines the random positions
/// @throws ConfigError for a faulty world, an unknown type, and a robot that overlaps something
WorldSource withChanges(const WorldSource&, const WorldChanges&, std::uint64_t seed);

/// A world file or a map with these changes: what each command and the Python package build from their arguments.
/// @param seed of random places @throws ConfigError as withChanges() and loadWorld()
LoadedWorld changedWorld(const std::string& file, const WorldChanges& changes, const ControllerCheck& check_controller,
                         std::uint64_t seed);

}  // namespace robosim
