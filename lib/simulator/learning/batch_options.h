#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace robosim {

/// Weights of an agent's reward in one step. The reward is the sum of each weight times its quantity.
struct RewardWeights {
  double win = 1;      ///< 1 in the step in which the agent's world is won, for each of its agents
  double forward = 0;  ///< distance driven forwards [m]; negative when reversing
  double heat = 0;     ///< increase of the reading of the agent's first heat sensor [°C]; 0 without one
  double stall = 0;    ///< 1 when the move was clipped or refused; use a negative weight
  double step = 0;     ///< 1 in each step
};

/// What the agents of an EnvironmentBatch observe, and how their episodes begin and end.
struct BatchOptions {
  std::size_t environments = 1;  ///< > 0; environment i uses world i modulo the number of worlds
  std::size_t agents = 0;        ///< the first robots of each world, which are controlled; 0: all
  /// Parts of an observation, in this order: a kind of sensor (the first one of the robot) or a sensor's label,
  /// "stalled", "pose". Agents of another robot type leave out those that they do not have.
  std::vector<std::string> observations{"sonar", "heat"};
  RewardWeights reward;
  double period_s = 0.1;           ///< length of a time step, (0, 1]
  std::uint32_t steps_max = 1000;  ///< an episode of so many steps is truncated; > 0
  bool has_random_starts = true;   ///< each episode starts at random poses (RandomStarts); else at the world's
  /// Minimum distance of random starts from the gold [m], at least 0, instead of World::start_distance_m.
  std::optional<double> start_distance_m = {};
  int threads = 1;           ///< does not affect the results
  bool has_digests = false;  ///< whether Environment::digest() of the environments is computed in each step
  std::uint64_t seed = 1;
};

}  // namespace robosim
