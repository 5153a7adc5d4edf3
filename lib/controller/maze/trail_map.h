#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "maze/grid.h"

namespace robosim {

/// Virtual pheromone of a team on a square lattice: each visit of a cell adds 1, and the sum decays exponentially.
class TrailMap {
 public:
  /// @param cell_m > 0 @param evaporation_s time in which pheromone decays to 1/e, > 0 @param period_s of a time step
  TrailMap(double cell_m, double evaporation_s, double period_s)
      : trails_(cell_m), evaporation_steps_(evaporation_s / period_s) {}

  Cell cellAt(const mrpt::math::TPoint2D& place) const { return trails_.cellAt(place); }
  double cellSize() const { return trails_.cellSize(); }
  /// Adds a visit. @param step number of the present step; must not decrease
  void visit(const Cell& cell, std::uint64_t step);
  /// Pheromone in a cell, >= 0.
  double amount(const Cell& cell, std::uint64_t step) const;

 private:
  struct Trail {
    double amount = 0;  ///< in `step`
    std::uint64_t step = 0;
  };
  double decayed(const Trail& trail, std::uint64_t step) const;

  Grid<Trail> trails_;
  double evaporation_steps_;
};

/// Message between robots: a visit of a cell of the lattice in the world frame. As text: "TRAIL <x> <y>".
struct TrailMessage {
  Cell cell;

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<TrailMessage> parse(const std::string& text);
};

}  // namespace robosim
