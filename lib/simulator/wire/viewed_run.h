#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hardware/readings.h"
#include "robosim/v1/viewing.pb.h"
#include "robots/run_snapshot.h"
#include "robots/world_source.h"

namespace robosim {

/// Robots whose readings a viewer receives in addition to all poses.
struct ReadingsSelection {
  bool of_all = false;            ///< readings of all robots, without camera pictures
  std::vector<std::uint32_t> of;  ///< all readings of these robots, by index in the world
  bool operator==(const ReadingsSelection&) const = default;
};

/// State of a run as received by a viewer: the world, and its robots at one step.
struct ViewedRun {
  LoadedWorld world;
  std::string world_version;
  double period_s = 0;       ///< length of a time step
  bool may_operate = false;  ///< whether the viewer's token permits to start, pause and step the run
  std::string winner;        ///< name of the robot that has won; empty until then

  /// With the readings of the selected robots, whose measurements are in the order of RobotInfo::sensors. A camera's
  /// picture is the newest, and is present only in the first frame that contains it.
  RunSnapshot snapshot;
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> picture_steps;  ///< by robot and sensor, of this frame

  std::vector<std::optional<Readings>> spare_readings;  ///< by robot: of former frames, whose memory is used again

  /// A robot's readings at this step; null unless selected.
  const Readings* readingsOf(std::size_t robot) const {
    const auto& readings = snapshot.robots[robot].readings;
    return readings ? &*readings : nullptr;
  }
  /// Step at which a camera took the picture in readingsOf(robot); nullopt when there is none.
  std::optional<std::uint64_t> pictureStep(std::size_t robot, std::size_t sensor) const;
};

void encode(const ReadingsSelection& selection, v1::FrameRequest& out);
/// Decodes a selection: sorted, without duplicates.
/// @param robots number of robots; higher indices are ignored
ReadingsSelection decode(const v1::FrameRequest& in, std::size_t robots);

/// Adds what has changed: all objects, or the places of those that have moved.
/// @param sent the objects of the frames before
void encode(const ChangedObjects& objects, const std::vector<WorldObject>& sent, v1::Frame& out);

/// Encodes a robot's state without readings.
void encode(const RobotSnapshot& snapshot, std::size_t robot, v1::RobotView& out);
/// Steps of the last readings that a viewer has received, by robot; nullopt for a robot without any.
using SentSteps = std::vector<std::optional<std::uint64_t>>;

/// Adds the selected readings, without pictures.
/// @param readings by robot
/// @param sent_steps to the same viewer, as many as robots; replaced for the selected robots
void encode(const std::vector<Readings>& readings, const ReadingsSelection& selection, SentSteps& sent_steps,
            v1::Frame& out);

/// Applies a frame, complete or incremental.
/// @return whether the frame replaced the world
/// @throws WireError for an invalid frame, ConfigError for a world that cannot be built.
bool update(ViewedRun& run, const v1::Frame& frame);

}  // namespace robosim
