#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "hardware/robot_velocity.h"
#include "recording/mcap_recording.h"
#include "run/outputs/run_note.h"
#include "topics/topic.h"

namespace robosim {

/// The true velocity of a robot in the last step.
RobotVelocity trueVelocity(const State& state, std::size_t robot);
std::vector<RobotVelocity> trueVelocities(const State& state);

/// The topics of a run besides those of its robots (doc/ros2.md): the map and the objects of the world, interventions
/// and events; and what an MCAP file says about the run.
class WorldTopics {
 public:
  explicit WorldTopics(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  /// Writes the map and the objects as they are, and attaches the world file.
  /// @param note of the run, without outcome
  void begin(McapRecording& recording, const RunNote& note, const ChangedObjects& objects, std::uint64_t time_ns);
  /// The following steps are compared with these objects and this winner, as after begin().
  void startFrom(const ChangedObjects& objects, const std::string& winner);
  /// @name The state for a reader that comes later
  ///@{
  TopicMessage map(std::uint64_t time_ns) const;
  TopicMessage objects(const ChangedObjects& objects, std::uint64_t time_ns) const;
  ///@}
  /// Messages of a step. @param notes interventions before it @param winner name of the robot that has won so far
  std::vector<TopicMessage> of(const ChangedObjects& objects, const std::vector<std::string>& notes,
                               const std::string& winner, std::uint64_t time_ns);
  /// The same, of objects that the caller has compared with those before.
  /// @param moved what movedBetween() has returned; null when nothing has changed
  std::vector<TopicMessage> of(const ChangedObjects& objects, const std::optional<std::vector<std::uint32_t>>* moved,
                               const std::vector<std::string>& notes, const std::string& winner, std::uint64_t time_ns);
  /// Writes the outcome. @param note of the run, with outcome
  static void end(McapRecording& recording, const RunNote& note);

 private:
  TopicMessage markers(const std::vector<WorldObject>& objects, const std::vector<std::uint32_t>* moved,
                       std::uint64_t time_ns) const;

  std::shared_ptr<const Model> model_;
  ChangedObjects objects_;  ///< of the last message
  std::string winner_;
};

}  // namespace robosim
