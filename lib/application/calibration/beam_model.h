#pragma once
#include <vector>

namespace robosim {

/// Beam model of Thrun, Burgard & Fox, *Probabilistic Robotics* (2005), §6.3: a mixture of four densities.
struct BeamModel {
  double z_hit = 0.7;             ///< weight of the Gaussian about the expected range
  double z_short = 0.1;           ///< … of the exponential below the expected range
  double z_max = 0.1;             ///< … of readings without an echo
  double z_rand = 0.1;            ///< … of the uniform density up to the maximum range
  double sigma_hit_m = 0.05;      ///< of the Gaussian
  double lambda_short_per_m = 1;  ///< of the exponential
};

/// A reading with the range that is expected by a map.
struct ExpectedReading {
  double read_m = 0;  ///< NaN without an echo
  double expected_m = 0;
};

/// Estimates the model by expectation maximisation (Table 6.2 of the book), until no parameter changes by more than
/// 1e-6, in at most 200 iterations.
/// @param readings at least one
/// @throws Interrupted when a signal requests the end
BeamModel fitBeamModel(const std::vector<ExpectedReading>& readings, double range_max_m);

}  // namespace robosim
