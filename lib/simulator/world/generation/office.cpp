#include "base/random.h"
#include "base/xml_element.h"
#include "world/generation/bounds_check.h"
#include "world/generation/generators.h"

namespace robosim {
namespace {

constexpr double kCorridor_m = 2;
constexpr double kDoor_m = 1;
constexpr double kDoorToCorner_m = 0.3;

/// Draws walls with doors.
class Office {
 public:
  Office(const OfficeOptions& options, Rng& rng, std::vector<WorldObject>& objects)
      : options_(options), rng_(rng), objects_(objects) {}

  /// A row of rooms between two heights, each with a door at `door_y`; deep rows have a second room behind the first.
  void addRooms(double y_min, double y_max, double door_y) {
    const double half_m = options_.width_m / 2;
    double x = -half_m;
    while (x < half_m) {
      double next = rounded(x + options_.room_m * rng_.uniform(1, 1.8));
      if (half_m - next < options_.room_m) next = half_m;
      addHorizontal(x, next, door_y);
      const double far_y = door_y == y_min ? y_max : y_min;
      if (y_max - y_min >= 2 * options_.room_m) {
        const double depth = rounded(rng_.uniform(options_.room_m, y_max - y_min - options_.room_m));
        addHorizontal(x, next, door_y + (far_y > door_y ? depth : -depth));
      }
      if (next < half_m) add(next, (y_min + y_max) / 2, kWallThickness_m, y_max - y_min);
      x = next;
    }
  }

 private:
  /// A wall along x with a door at a random place.
  void addHorizontal(double x_min, double x_max, double y) {
    const double margin_m = kDoorToCorner_m + kDoor_m / 2;
    const double door = rounded(rng_.uniform(x_min + margin_m, x_max - margin_m));
    addSpan(x_min, door - kDoor_m / 2, y);
    addSpan(door + kDoor_m / 2, x_max, y);
  }
  void addSpan(double from, double to, double y) { add((from + to) / 2, y, to - from, kWallThickness_m); }
  void add(double x, double y, double length_m, double width_m) {
    objects_.push_back(wall("Wall" + std::to_string(objects_.size() + 1), x, y, length_m, width_m));
  }

  const OfficeOptions& options_;
  Rng& rng_;
  std::vector<WorldObject>& objects_;
};

}  // namespace

Scenery generateOffice(const OfficeOptions& o, std::uint64_t seed) {
  requireWithin("width", o.width_m, 10, 1000);
  requireWithin("length", o.length_m, 10, 1000);
  requireWithin("room", o.room_m, 2, 100);
  const double y_m = o.length_m / 2;
  if (o.room_m > y_m - kCorridor_m / 2 || o.room_m > o.width_m) {
    throw ConfigError("rooms of " + toText(o.room_m) + " m do not fit beside the corridor; make the office larger");
  }
  Rng rng(seed, RandomPurpose::scenery);
  Scenery scenery;
  scenery.bounds = {-o.width_m / 2, o.width_m / 2, -y_m, y_m};
  addOuterWalls(scenery.bounds, scenery.objects);
  Office office(o, rng, scenery.objects);
  office.addRooms(kCorridor_m / 2, y_m, kCorridor_m / 2);
  office.addRooms(-y_m, -kCorridor_m / 2, -kCorridor_m / 2);
  scenery.places = placesAmong(scenery.objects, scenery.bounds, 0.25, 0.35);
  return scenery;
}

}  // namespace robosim
