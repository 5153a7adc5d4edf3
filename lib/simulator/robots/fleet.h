#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "base/rare.h"
#include "base/shared_value.h"
#include "robots/robot_model.h"
#include "robots/robot_types.h"
#include "world/world.h"

namespace robosim {

/// A robot of a world with its model resolved.
struct FleetRobot {
  RobotInfo info;
  std::shared_ptr<const RobotModel> model;
  mrpt::math::TPose2D world_from_start;
  std::array<float, 3> color = Body().color;  ///< in all views
  Rare<Body> own_body = {};                   ///< instead of the model's; its pose and colour have no effect
  SharedValue<std::string> controller;        ///< as TypeChoice::text(); empty: the program's default

  /// At the start, in its colour; other robots' sensors detect this shape.
  Body body() const;
};

/// Robot types of which robots can be added to a fleet.
struct KnownTypes {
  RobotTypes types;
  std::string world_file;  ///< further types are in its robotTypeFolders()
  /// Models of types that were read: robots of a type share one.
  std::map<std::string, std::shared_ptr<const RobotModel>> models;
};

/// Robots of a world, in the world's order.
struct Fleet {
  std::vector<FleetRobot> robots;
  std::shared_ptr<const KnownTypes> known_types = {};  ///< null: none
};

/// @name Limits over all robots of a world, which bound the memory of a run
///@{
constexpr std::size_t kWorldBeamsMax = 50'000'000;     ///< beams of all robots' sensors; 16 bytes per reading
constexpr std::size_t kWorldModelRaysMax = 2'000'000;  ///< Sensor::rayCount() of all robot models, each counted once
/// Bytes of the ray-cast pictures of all robots, and of what is computed once for each pixel of a robot model.
constexpr std::size_t kWorldPictureBytesMax = 2'000'000'000;
///@}

/// A placed robot with its model, in the colour of its placement or body.
FleetRobot placedRobot(const RobotPlacement& placement, std::shared_ptr<const RobotModel> model);

/// Checks a controller of a world file, given as TypeChoice::text(). @throws ConfigError
using ControllerCheck = std::function<void(const std::string& controller)>;

/// Makes the model of each placed robot, and of each that the world's timeline adds, and checks its start. Adds to
/// `errors`: unknown models, faulty sensors, controllers that `check_controller` rejects (null accepts all), robots
/// outside the bounds, robots that overlap an object or another robot, and the first robot that exceeds the limit of
/// beams or rays. `world_file` names the file in errors.
Fleet buildFleet(const World&, const std::string& world_file, const RobotTypes& types,
                 const ControllerCheck& check_controller, ErrorList& errors);

/// A robot of a type, alone, at the origin. @throws ConfigError for an unknown or faulty type
FleetRobot robotOfType(const RobotTypes& types, const std::string& model);

/// Makes the fleet of a world whose robots have, one by one, the types, bodies and sensors of those of another world,
/// without reading any robot type. Adds to `errors` robots at starts as above.
/// @param alike fleet of the other world, whose models are shared
/// @throws std::invalid_argument for another number of robots
Fleet buildFleet(const World&, const std::string& world_file, const Fleet& alike, ErrorList& errors);

/// Whether any robot has another drive than a differential one.
bool hasOtherDrives(const Fleet& fleet);

/// Whether any robot has a camera, of whatever model.
bool hasCamera(const Fleet& fleet);
/// Whether a robot has a camera whose pictures an ImageSource renders: one that is not ray-cast.
bool needsImageSource(const RobotInfo& robot);
bool needsImageSource(const Fleet& fleet);

/// A world and its robots.
struct LoadedWorld {
  World world;
  Fleet fleet;
};

/// Completes a world that was read: places what it scatters, builds its fleet, and moves robots from blocked start
/// poses of maps (robots/start_places.h).
/// @param world_file names the file in errors @param warnings receives what was moved; null: it is logged
LoadedWorld placedWorld(World world, const std::string& world_file, const RobotTypes& types,
                        const ControllerCheck& check_controller, std::uint64_t seed, ErrorList& errors,
                        std::vector<std::string>* warnings = nullptr);

/// Reads a world file and completes it by placedWorld().
/// @param seed of the run
/// @throws ConfigError with every fault found.
LoadedWorld loadWorld(const std::filesystem::path& file, const ControllerCheck& check_controller,
                      std::uint64_t seed = 1);

}  // namespace robosim
