#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim {

/// @param values at least one
double median(std::vector<double> values);

/// Clock readings of a process.
struct Clocks {
  double wall_s = 0;
  double cpu_s = 0;  ///< of all threads; excludes time in which other programs run
  static Clocks now();
};

/// Cost of a unit of work, such as a robot-step.
struct Cost {
  double wall_s = 0;
  double cpu_s = 0;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cost, wall_s, cpu_s)

/// A subject of a measurement.
struct Contender {
  std::function<double()> work;           ///< does some work and returns the number of units done
  std::function<void()> prepare = [] {};  ///< called before each work(); not timed
  /// Clocks of the working process, if it is another one.
  std::function<Clocks()> clocks = Clocks::now;
};

/// Measures several contenders alternately, in rounds, so that other load on the machine affects all of them equally.
/// @param min_s minimum working time of each contender over all rounds; a round has at least one call of work()
/// @return cost per unit of each: median of its rounds, separately for wall and CPU time
std::vector<Cost> measureAlternately(std::span<const Contender> contenders, double min_s);

/// Number of rounds; odd, so that the median is one of them.
constexpr std::size_t kRounds = 9;

}  // namespace robosim
