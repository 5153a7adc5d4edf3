#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"

namespace robosim {

/// The world from above, as whoever may know the truth tells it: what the console's map shows.
struct MapWorld {
  struct Thing {
    mrpt::math::TPose2D world_from_thing;
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
  std::vector<Thing> things;
  std::vector<Robot> robots;
};

struct MapView {
  std::shared_ptr<const MapWorld> world;  ///< null while there is none
  std::string problem;                    ///< why there is none
  std::uint64_t step = 0;
  std::vector<mrpt::math::TPose2D> world_from_robot;  ///< in the order of MapWorld::robots
  std::vector<Activity> activity;
};

/// Who tells it. Called from one thread.
class MapSource {
 public:
  virtual ~MapSource() = default;
  /// Whether anybody wants to see a map: nobody does at first.
  virtual void want(bool wanted) = 0;
  /// The newest; never null.
  virtual std::shared_ptr<const MapView> newest() = 0;
};

}  // namespace robosim
