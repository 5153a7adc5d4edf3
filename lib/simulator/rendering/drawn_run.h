#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "hardware/sensor_info.h"
#include "rendering/density_map.h"
#include "rendering/detail_level.h"
#include "rendering/path_gap.h"
#include "world/changed_objects.h"
#include "world/world.h"

namespace robosim {

/// An event of a run at a place.
struct RunEvent {
  enum class Kind { gold, message, stall };  ///< found gold; sent a message; was stopped by an obstacle
  Kind kind;
  std::size_t robot;
  mrpt::math::TPoint2D at;  ///< of the robot, world frame
};

/// Collects the events of a run from the states of its robots, in the order of time.
class RunEvents {
 public:
  struct Timed {
    double time_s = 0;
    RunEvent event;
  };

  /// Adds a robot's state after a step: a stall is an event when it begins, gold when it is found for the first time.
  /// @param at nullopt for a robot whose position is unknown; its events are left out
  void addState(std::size_t robot, bool is_stalled, bool has_found, const std::optional<mrpt::math::TPoint2D>& at,
                double time_s);
  /// Adds a message when it has been received; several of one robot and time are one event.
  void addMessage(std::size_t sender, const std::optional<mrpt::math::TPoint2D>& at, double time_s);
  /// In the order in which they were added.
  const std::vector<Timed>& all() const { return all_; }
  void clear() { *this = RunEvents(); }

 private:
  struct Last {
    bool is_stalled = false, has_found = false;
    std::optional<double> message_s;
  };
  Last& lastOf(std::size_t robot);

  std::vector<Timed> all_;
  std::vector<Last> last_;  ///< by robot
};

/// What a range sensor measured, in the world frame [m].
struct SensedArea {
  SensorKind kind;
  std::vector<std::vector<mrpt::math::TPoint2D>> free{};   ///< freeAreas()
  std::vector<mrpt::math::TPoint2D> echoes{};              ///< within the sensor's range
  std::vector<std::vector<mrpt::math::TPoint2D>> lines{};  ///< sightLines()
};

/// Content of a plan or figure. Vectors by robot are in the world's order, or empty.
struct DrawnRun {
  std::string title{};  ///< empty: the world's name
  /// Of each robot's centre, world frame; may be empty. Pieces are separated by kPathGap.
  std::vector<std::vector<mrpt::math::TPoint2D>> paths{};
  /// Times of the points of `paths` [s], by which the paths of many robots fade; empty: equal times between points.
  std::vector<std::vector<double>> path_times_s{};
  /// Final poses; a robot without one is not drawn.
  std::vector<std::optional<mrpt::math::TPose2D>> world_from_robot{};
  std::vector<RunEvent> events{};
  std::vector<SensedArea> sensed{};
  ChangedObjects objects{};             ///< where they are then, instead of the world's
  bool has_names = true;                ///< whether the names of robots and hot objects are written
  bool has_starts = true;               ///< whether the beginning of each path has a ring
  std::optional<DensityMap> density{};  ///< drawn on the floor; of a crowded picture instead of paths and robots
};

/// Leaves out the robots, paths and events that layers do not show, and adds the density map.
void applyLayers(DrawnRun&, const ViewLayers&, const World&, const Fleet&);
/// The area that a picture of a run covers: the world's bounds, every object, map and path.
Bounds2D areaOf(const World&, const DrawnRun&);
/// The run as far as it can be drawn without covering the plane, in a picture of a scale (DetailLevel).
DrawnRun reduced(const World&, DrawnRun, double px_per_m);
/// The level of detail of that picture.
DetailLevel detailOf(const World&, const DrawnRun&, double px_per_m);

}  // namespace robosim
