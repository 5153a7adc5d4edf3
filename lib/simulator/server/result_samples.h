#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "environment/environment.h"

namespace robosim {

/// Random sample of a geometry worker's results that the environment recomputes and compares bit for bit. The sample is
/// selected by a hash (XXH3) of a secret, the worker and the step, and is unpredictable to the worker.
class ResultSamples {
 public:
  /// @param fraction of a worker's robots that is checked in each step, [0, 1]; at least one robot
  /// @param secret unpredictable to workers
  ResultSamples(double fraction, std::uint64_t secret) : fraction_(fraction), secret_(secret) {}

  /// Measurements of one robot as computed by the environment.
  struct Expected {
    std::size_t robot;
    std::vector<Measurement> measurements;  ///< of the sensors that a replica may compute
  };
  /// Computes a sample for the robots `share` of one worker.
  std::vector<Expected> compute(Environment& environment, RobotRange share, std::uint64_t worker) const;
  /// The first robot of the sample whose measurements in the environment differ from the expected ones.
  static std::optional<std::size_t> firstDifference(const std::vector<Expected>& sample,
                                                    const Environment& environment);

 private:
  double fraction_;
  std::uint64_t secret_;
};

}  // namespace robosim
