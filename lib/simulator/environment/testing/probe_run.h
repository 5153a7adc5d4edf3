#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "environment/environment.h"

namespace robosim {

/// Random runs for tests, with everything that a State contains: sensors of every kind with all of their errors,
/// pictures, messages that are lost or late, stalls, robots that halt, leave and come back, interventions, and requests
/// of CheckWin. A run depends on its seed only.
class ProbeRun {
 public:
  static constexpr std::uint32_t kRobots = 9;

  explicit ProbeRun(std::uint64_t seed);

  Environment& environment() { return *environment_; }
  /// An environment of the same model, in another state.
  std::unique_ptr<Environment> another(int threads = 1) const;
  /// Gives the environment the commands and messages of its next step.
  void prepare(Environment& environment) const;
  /// Gives the environment the commands and messages of its next step, and takes the step.
  void step(Environment& environment) const;
  void step() { step(*environment_); }
  /// A number in [0, n) that differs between seeds.
  std::uint32_t random(std::uint32_t n) const;

 private:
  std::uint64_t seed_;
  std::unique_ptr<ImageSource> images_;
  std::unique_ptr<Environment> environment_;
};

}  // namespace robosim
