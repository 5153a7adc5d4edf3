#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "world/generation/places.h"
#include "world/world.h"

namespace robosim {

/// Walls and obstacles of a generated world, and where robots and gold may be.
struct Scenery {
  Bounds2D bounds;
  std::vector<WorldObject> objects;
  Places places;
};

/// What a generated world contains besides its scenery.
struct TeamOptions {
  int robots = 8;                                          ///< 0 to 1,000,000
  std::vector<std::string> models{"pioneer3dx", "scout"};  ///< robot types, used in turn; not empty
  std::string controller = "gold_finder";                  ///< as TypeChoice::text(); empty: the program's default
  bool has_gold = true;
};

/// @name Dimensions of generated worlds [m]
///@{
constexpr double kWallHeight_m = 0.6;
constexpr double kWallThickness_m = 0.1;
constexpr double kStartDistance_m = 0.8;  ///< minimum between the centres of two robots
///@}

/// Rounded to thousandths, which keeps world files short.
double rounded(double value);

/// A box of a wall's height and colour.
WorldObject wall(const std::string& name, double center_x_m, double center_y_m, double length_m, double width_m);
/// Four walls along the inner side of the bounds.
void addOuterWalls(const Bounds2D& bounds, std::vector<WorldObject>& objects);

/// The world with robots and gold. The first robot stands at a random place, each further one, and then the gold, at
/// the place that is farthest from those before. Robots head in random multiples of 90°, and each has the next as its
/// neighbour.
/// @throws ConfigError when there are fewer places than robots
World populated(Scenery scenery, const TeamOptions& team, std::uint64_t seed);

}  // namespace robosim
