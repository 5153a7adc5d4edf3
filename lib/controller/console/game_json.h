#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "console/best_of_day.h"
#include "console/rounds.h"

namespace robosim {

/// Outcome of the last round, or of the last win on a console without rounds.
struct GameResult {
  std::uint64_t number = 0;  ///< of the result, from 1
  RoundResult result;
  std::size_t rank = 0;  ///< among the wins of the day, from 1; 0 if not won
};

/// What visitors are shown of rounds and results.
/// @param rounds null for a console without rounds
/// @param result null as long as there is none
std::string gameJson(const Rounds* rounds, Rounds::Time now, const GameResult* result, const BestOfDay& best);

}  // namespace robosim
