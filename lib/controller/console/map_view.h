#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"

namespace robosim {

/// Ground truth from above for the console's map.
struct MapWorld {
  struct Object {
    mrpt::math::TPose2D world_from_object;
    double length_m = 0, width_m = 0;  ///< of a box; 0 for a disc
    double radius_m = 0;               ///< of a disc
    std::array<float, 3> color{};      ///< red, green, blue, each in [0, 1]
    bool is_hot = false;
  };
  struct Robot {
    std::string name;
    double radius_m = 0;
    std::array<float, 3> color{};
  };
  std::string name;
  double x_min_m = 0, x_max_m = 0, y_min_m = 0, y_max_m = 0;
  std::vector<Object> objects;
  std::vector<Robot> robots;
};

struct MapView {
  std::shared_ptr<const MapWorld> world;  ///< null while not available
  std::string problem;                    ///< reason why it is not available
  std::uint64_t step = 0;
  std::vector<mrpt::math::TPose2D> world_from_robot;  ///< in the order of MapWorld::robots
  std::vector<Activity> activity;
  /// Present places of the objects, in the order of MapWorld::objects; null while they are those of `world`.
  std::shared_ptr<const std::vector<mrpt::math::TPose2D>> world_from_object;
};

/// Source of the map. Called from one thread.
class MapSource {
 public:
  virtual ~MapSource() = default;
  /// Sets whether any page shows the map; initially none does.
  virtual void setWatched(bool is_watched) = 0;
  /// The newest; never null.
  virtual std::shared_ptr<const MapView> newest() = 0;
};

}  // namespace robosim
