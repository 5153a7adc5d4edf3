#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim {

/// What the clocks of this process read.
struct Clocks {
  double wall_s = 0;
  double cpu_s =
      0;  ///< by all its threads; unlike the wall's, this clock stands while other programs have the processor
  static Clocks now();
};

/// What a unit of work, a robot-step say, costs.
struct Cost {
  double wall_s = 0;
  double cpu_s = 0;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cost, wall_s, cpu_s)

/// Something to be measured.
struct Contender {
  std::function<double()> work;           ///< does some work, and returns how many units it was
  std::function<void()> prepare = [] {};  ///< what goes before each work, and is not counted
};

/// Lets each of several work for a while, one after the other, round after round, so that whatever else the machine is
/// busy with meets all of them alike.
/// @param least_s how long each works at least, all its rounds together; a round is at least one work
/// @return what a unit costs each: the median of its rounds, of wall and of CPU time by itself
std::vector<Cost> takeTurns(std::span<const Contender> contenders, double least_s);

/// How many rounds; odd, so that one is the median.
constexpr std::size_t kRounds = 9;

}  // namespace robosim
