#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "net/viewing.pb.h"
#include "robots/world_source.h"

namespace robosim {

/// What a viewer sees of a robot.
struct RobotLook {
  mrpt::math::TPose2D world_from_robot;
  float laser_pan_rad = 0;
  bool stalled = false;
  Activity activity = Activity::active;
  bool operator==(const RobotLook&) const = default;
};

/// Whose readings a viewer wants to see, beside where everyone is.
struct ReadingsWish {
  bool of_all = false;            ///< everybody's, but for their cameras' pictures
  std::vector<std::uint32_t> of;  ///< all readings of these robots, by their places in the world's list
  bool operator==(const ReadingsWish&) const = default;
};

/// What a viewer knows of a run: the world, and its robots at one step.
struct Sight {
  LoadedWorld world;
  std::string world_version;
  double period_s = 0;       ///< length of a time step
  bool may_operate = false;  ///< whether this viewer's token lets it start, pause and step the run, as a control panel
  std::uint64_t step = 0;
  double time_s = 0;
  std::vector<RobotLook> robots;  ///< in the world's order
  std::string winner;             ///< the robot that has won; empty for as long as none has

  /// What a robot's sensors measured at this step, in the order of its RobotInfo::sensors; null unless the viewer has
  /// asked for it. A camera's picture is the newest, and is there once: when it is new to the viewer.
  const Readings* readingsOf(std::size_t robot) const { return has_readings[robot] ? &readings[robot] : nullptr; }

  std::vector<Readings> readings;          ///< in the world's order; of this step or one before it
  std::vector<std::uint8_t> has_readings;  ///< by robot: 1 for those of this step
};

void encode(const ReadingsWish& wish, wire::FrameRequest& out);
/// The robots in order, each once.
/// @param robots how many there are; others count for nothing
ReadingsWish decode(const wire::FrameRequest& in, std::size_t robots);

void encode(const RobotLook& look, std::size_t robot, wire::RobotView& out);
/// Adds the readings wished for, but for their pictures.
/// @param readings by robot
void encode(const std::vector<Readings>& readings, const ReadingsWish& wish, wire::Frame& out);

/// Takes over what a frame tells: all of it, or what has changed.
/// @return whether the world is another
/// @throws WireError for a frame that makes no sense, ConfigError for a world that cannot be built here.
bool update(Sight& sight, const wire::Frame& frame);

}  // namespace robosim
