#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <nlohmann/json.hpp>

#include "hardware/readings.h"
#include "robots/fleet.h"
#include "run_page/run_page.h"
#include "world/changed_objects.h"
#include "world/world.h"

namespace robosim {

/// A robot at a moment of a live run.
struct LiveRobot {
  mrpt::math::TPose2D world_from_robot;
  PageRobotState state;
  const Readings* readings = nullptr;  ///< null: unknown
};

/// What happened since the moment before: a message or an intervention.
struct LiveEvent {
  std::string kind;                  ///< "message" or "intervention"
  std::optional<std::size_t> robot;  ///< nullopt: of none
  std::string text;
};

/// A moment of a live run. It refers to readings of the run, and is valid as long as these.
struct LiveMoment {
  double time_s = 0;
  std::vector<LiveRobot> robots;  ///< in the world's order
  ChangedObjects objects;
  std::vector<LiveEvent> events;
};

/// What an item states decides how long pages that are opened later need it (LiveHistory).
enum class LiveItemKind {
  moment,   ///< the next moment makes it obsolete for a page that shows the present
  event,    ///< what happened
  objects,  ///< the objects from now on; the next list replaces it
  robots,   ///< robots that were added: later moments refer to them
};

/// One message to pages about a run.
struct LiveItem {
  std::string text;  ///< JSON
  LiveItemKind kind = LiveItemKind::moment;
};

/// Encodes a live run for pages: a description, and items for each moment (live_source.js reads both). Poses are
/// rounded to 0.1 mm and 0.01 mrad, times to 1 us, readings to 6 digits.
class LiveEncoding {
 public:
  static constexpr double kPlace_m = 1e-4, kHeading_rad = 1e-5, kTime_s = 1e-6;
  /// Numbers of the readings of all robots at a moment up to which a page receives them.
  static constexpr std::size_t kMaxReadings = 3000;
  /// Events of a moment; further ones are left out.
  static constexpr std::size_t kMaxEvents = 50;

  /// @param id another one for each run
  LiveEncoding(std::string id, std::string title, const World& world, const Fleet& fleet,
               std::vector<std::pair<std::string, std::string>> facts = {});

  /// Describes the run, with the robots that have been added.
  std::string description() const;
  /// Whether a run in a world can be the one that is described: the first robots of its fleet are those described.
  bool canBeOf(const World& world, const Fleet& fleet) const;
  /// Describes robots that have been added to the fleet; none if none have.
  std::vector<LiveItem> addRobots(const Fleet& fleet);
  /// The items of the next moment, in their order.
  /// @pre the robots of the fleet
  std::vector<LiveItem> add(const LiveMoment& moment);
  bool hasReadings() const { return readings_ <= kMaxReadings; }

 private:
  struct Sensor {
    std::string name;
    std::vector<std::string> columns;
  };

  void addRobot(const FleetRobot& robot);
  nlohmann::ordered_json sensors() const;
  nlohmann::ordered_json remarks() const;
  std::size_t sensorNamed(const std::string& name, const std::vector<std::string>& columns);
  void addReadings(const LiveMoment& moment, std::string& text) const;
  LiveItem objectsItem(const LiveMoment& moment);

  std::string id_, title_;
  std::vector<WorldObject> of_world_;
  std::string world_;  ///< JSON
  nlohmann::ordered_json types_ = nlohmann::ordered_json::array(), robots_ = nlohmann::ordered_json::array();
  std::vector<std::pair<std::string, std::string>> facts_;
  std::vector<Sensor> sensors_;
  std::vector<std::vector<std::size_t>> sensors_of_robot_;  ///< indices in sensors_, by robot and sensor
  std::optional<std::size_t> status_;                       ///< index of the sensor with the angles of panning ones
  std::size_t readings_ = 0;                                ///< numbers of all robots
  bool had_readings_ = false;                               ///< hasReadings() at the beginning
  std::optional<ChangedObjects> objects_;                   ///< of the last moment
  std::vector<std::uint32_t> moving_;                       ///< indices of the objects that move
};

}  // namespace robosim
