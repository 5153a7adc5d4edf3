#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <nlohmann/json.hpp>

#include "hardware/command.h"
#include "robots/fleet.h"
#include "run_page/page_document.h"
#include "run_page/page_readings.h"
#include "run_page/pose_track.h"
#include "world/changed_objects.h"
#include "world/world.h"

namespace robosim {

/// State of a robot besides its pose.
struct PageRobotState {
  Activity activity = Activity::active;
  bool is_stalled = false, has_won = false, by_driver = false;
  std::uint32_t led_color = 0;  ///< 0xRRGGBB; 0: off
  bool operator==(const PageRobotState&) const = default;
  /// All but the colour, as pages receive them (States in page/run.js).
  unsigned flags() const {
    return static_cast<unsigned>(activity) | (is_stalled ? 4U : 0U) | (has_won ? 8U : 0U) | (by_driver ? 16U : 0U);
  }
};

/// Collects a run moment by moment, and encodes it as a page that needs nothing else: HTML with the program that shows
/// the run (`page/`), and the run's data (doc/run_page.md). What does not fit into maxBytes() is left out by stated
/// rules: readings (PageReadings), poses (PoseTrack), late messages, states and changes of objects.
class RunPage {
 public:
  /// The most events with a text of their own, such as messages.
  static constexpr std::size_t kMaxTexts = 50'000;

  /// Size of a page [bytes]: 1.4 MB for a run of up to 40 minutes of robots, in proportion for longer ones, up to 14
  /// MB.
  static std::size_t maxBytes(std::size_t robots, double duration_s);

  /// @param title of the page, as text
  explicit RunPage(std::string title) : title_(std::move(title)) {}

  /// @name Description
  ///@{
  /// Without it, the ground covers the robots' poses.
  void setWorld(const World& world) { world_ = world; }
  /// @return index of the robot, in the order of the calls
  std::size_t addRobot(FleetRobot robot);
  std::size_t robots() const { return robots_.size(); }
  /// A fact about the run: name and value, such as its seed.
  void addFact(std::string name, std::string value) { facts_.emplace_back(std::move(name), std::move(value)); }
  /// Layers that the page does not show until they are switched on: names of `LAYERS` in page/main.js.
  void setHidden(std::vector<std::string> layers) { hidden_ = std::move(layers); }
  /// A sentence about what the page does not show, or why the run ends early.
  void addRemark(std::string text) { remarks_.push_back(std::move(text)); }
  ///@}

  /// @name Moments
  ///@{
  /// Begins the next moment. A time before that of the moment before counts as that. When only the moment before is
  /// more than a second ahead, its time was wrong, and becomes the new one. Times are limited to 2^51 us.
  void beginMoment(double time_s);
  std::uint64_t moment() const { return times_us_.empty() ? 0 : times_us_.size() - 1; }
  std::size_t moments() const { return times_us_.size(); }
  void setPose(std::size_t robot, const mrpt::math::TPose2D& world_from_robot);
  /// Forgets all poses of a robot.
  void clearPoses(std::size_t robot) { robots_[robot].track = PoseTrack(); }
  /// The way of a robot to its next pose is unknown.
  void interruptPath(std::size_t robot) { robots_[robot].track.interrupt(); }
  void setState(std::size_t robot, const PageRobotState& state);
  /// The objects from the next moment on.
  void setObjects(const ChangedObjects& objects) { next_objects_ = objects; }
  /// @param kind "message", "intervention" or "added" @param robot nullopt: of none
  /// @param is_next whether it is an event of the next moment
  void addEvent(const std::string& kind, std::optional<std::size_t> robot, const std::string& text,
                bool is_next = false);
  PageReadings& readings() { return readings_; }
  ///@}

  /// The page. Call once.
  /// @param progress called with what is being encoded; may throw to end it
  std::string html(const std::function<void(const std::string&)>& progress);
  /// Its data, instead.
  std::vector<PageBlock> blocks(const std::function<void(const std::string&)>& progress);

 private:
  struct StateChange {
    std::uint64_t moment;
    PageRobotState state;
  };
  struct Robot {
    FleetRobot described;
    PoseTrack track;
    std::vector<StateChange> states;
  };
  struct Event {
    std::uint64_t moment;
    std::string kind;
    std::optional<std::size_t> robot;
    std::string text;
  };
  /// The objects from a moment on, until there are others; the tracks are of those that move in this time.
  struct ObjectList {
    std::uint64_t moment = 0;
    ChangedObjects objects;
    std::vector<std::optional<PoseTrack>> tracks;  ///< by object
  };

  void noteObjects();
  nlohmann::ordered_json head() const;  ///< without events, readings and remarks
  nlohmann::ordered_json events(std::size_t count) const;
  /// Those that fit. @param remarks appended to if not all do
  nlohmann::ordered_json events(std::size_t budget_bytes, std::vector<std::string>& remarks) const;
  std::string tracks(const std::function<void(const std::string&)>& progress, std::size_t budget_bytes);
  std::string encodeStates(std::uint64_t moments) const;
  /// Those of the moments that fit. @param remarks appended to if not all do
  std::string states(std::size_t budget_bytes, std::vector<std::string>& remarks) const;
  std::string encodeTracks() const;

  std::string title_;
  std::optional<World> world_;
  std::vector<std::pair<std::string, std::string>> facts_;
  std::vector<std::string> remarks_, hidden_;
  std::vector<Robot> robots_;
  std::vector<std::int64_t> times_us_;
  bool are_times_limited_ = false;
  std::vector<Event> events_;
  std::size_t left_out_events_ = 0;
  std::vector<ObjectList> objects_;
  std::size_t listed_ = 0;                      ///< objects in the lists after the first
  std::optional<std::int64_t> objects_end_us_;  ///< from when on there are too many
  std::vector<std::uint64_t> last_moved_;       ///< by object of the last list: the moment
  ChangedObjects last_objects_, next_objects_;
  PageReadings readings_;
  TrackTolerance tolerance_;    ///< of the last simplification
  std::int64_t deviation_ = 1;  ///< sum of all tolerances, in units of the first
};

}  // namespace robosim
