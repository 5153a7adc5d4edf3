#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "benchmark/survival.h"

namespace robosim {

/// Comparison of two strategies on the same starts.
struct PairedComparison {
  std::size_t first_faster = 0;
  std::size_t second_faster = 0;
  std::size_t ties = 0;  ///< equal times, or neither succeeded
  double p = 1;          ///< of the sign test, two-sided
};

/// The exact sign test (Conover, "Practical Nonparametric Statistics", 3rd ed., 3.4). It is exact for searches that are
/// all ended at the same time limit: a success is always earlier than the end of a search without, by an unknown
/// amount, which tests of differences would need. @pre as many times of both, in the order of the seeds
PairedComparison comparePaired(std::span<const SearchTime> first, std::span<const SearchTime> second);

/// p values adjusted for their number (Holm, 1979), in the given order, so that the probability of any false rejection
/// is at most the level at which they are compared.
std::vector<double> holmAdjusted(std::span<const double> p);

}  // namespace robosim
