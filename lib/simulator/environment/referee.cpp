#include "environment/referee.h"

#include <algorithm>
#include <limits>

namespace robosim {

std::vector<Outline> findGold(const std::vector<WorldObject>& objects) {
  std::vector<Outline> gold;
  for (const auto& object : objects) {
    if (object.body.heat_celsius != 0) gold.push_back(object.body.solid().outline);
  }
  return gold;
}

Referee::Referee(const std::vector<WorldObject>& objects, double win_distance_m)
    : gold_(findGold(objects)), win_distance_m_(win_distance_m) {}

double Referee::distanceToGold(const Circle& disc) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& gold : gold_) nearest_m = std::min(nearest_m, distance(gold, disc));
  return nearest_m;
}

}  // namespace robosim
