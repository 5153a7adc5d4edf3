#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "environment/known_robots.h"
#include "geometry/shapes/solid.h"
#include "world/world.h"

namespace robosim {

/// Outlines of the gold among objects: of every hot one.
std::vector<Outline> findGold(const std::vector<WorldObject>& objects);

/// Decides which robot wins (2005: CheckWin). Candidates are the robots that
/// have requested CheckWin since the last decision and whose discs are within the world's win distance of gold, outline
/// to outline. The nearest candidate wins; of equally near ones, the first in the world's list. Heights are ignored.
class Referee {
 public:
  Referee(const std::vector<WorldObject>& objects, double win_distance_m);

  /// @param requests by robot, 1 for a request of CheckWin
  /// @param disc_of returns the disc of a robot, by its index, at its current pose
  /// @return the winner; nullopt if there is none
  template <typename DiscOf>
  std::optional<std::size_t> decide(std::span<const std::uint8_t> requests, const DiscOf& disc_of) const {
    std::optional<std::size_t> winner;
    if (gold_.empty()) return winner;
    double winner_m = win_distance_m_;
    forFlags(requests, [&](std::size_t i) {
      const double away_m = distanceToGold(disc_of(i));
      if (away_m > winner_m || (away_m == winner_m && winner)) return;
      winner = i;
      winner_m = away_m;
    });
    return winner;
  }

 private:
  double distanceToGold(const Circle& disc) const;  ///< [m]; infinite when there is no gold

  std::vector<Outline> gold_;
  double win_distance_m_;
};

}  // namespace robosim
