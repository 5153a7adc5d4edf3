#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "environment/environment.h"
#include "learning/batch_options.h"
#include "learning/observation_layout.h"
#include "robots/fleet.h"
#include "world/intervention.h"

namespace robosim {

/// Drives the robots of an environment that are no agents.
class OtherRobots {
 public:
  virtual ~OtherRobots() = default;
  virtual void act() = 0;  ///< gives their commands for the next step
};

/// Memory of the caller, into which EnvironmentBatch writes the results of a step, in row-major order.
struct BatchResults {
  /// Environments × agents × observationSize(). The end of an agent's observation that is shorter is 0.
  std::span<float> observations;
  std::span<double> rewards;           ///< environments × agents
  std::span<std::uint8_t> terminated;  ///< by environment; 1 when the world was won in this step
  std::span<std::uint8_t> truncated;   ///< by environment; 1 when the episode has reached BatchOptions::steps_max
};

/// Many environments that step together, for learning algorithms. Environments of one world share its Model. Episodes
/// follow Gymnasium 1.0's VectorEnv with next-step autoreset: the step in which an episode ends returns its final
/// observation; the next step ignores the actions of that environment, starts its next episode, and returns its first
/// observation with reward 0. An episode is terminated when a robot is near enough to the gold to win (Referee), and
/// truncated after a number of steps.
///
/// The results depend on the options and actions only, bit for bit, for any number of threads. An episode's start
/// poses, noise and lost messages, and its world if that is generated, depend on the seed of its environment and on the
/// number of the episode. Robots that are no agents stand still, unless MakeOthers drives them.
class EnvironmentBatch {
 public:
  /// Makes the world of an episode, which depends on the seed only; may be called from several threads at once.
  using MakeWorld = std::function<LoadedWorld(std::uint64_t seed)>;
  /// Makes what drives the robots of an environment from number `first` on, for one episode; null: they stand still.
  /// May be called from several threads at once. The environment outlives it.
  using MakeOthers = std::function<std::unique_ptr<OtherRobots>(Environment&, std::size_t first)>;

  /// @throws ConfigError for options out of range, worlds whose robots differ in number, and agents whose observations
  /// differ in size or bounds from those of the first world; errors of `others`
  EnvironmentBatch(std::vector<LoadedWorld> worlds, BatchOptions options, MakeOthers others = nullptr);
  /// Every episode of every environment has a world of its own (such as WorldGenerator makes). Before the first reset()
  /// all environments have the world of the first one's first episode.
  /// @throws ConfigError also for a world that cannot be made, here and when an episode starts; that environment's next
  /// step or reset then tries its next episode
  EnvironmentBatch(MakeWorld make, BatchOptions options, MakeOthers others = nullptr);
  ~EnvironmentBatch();
  EnvironmentBatch(const EnvironmentBatch&) = delete;
  EnvironmentBatch& operator=(const EnvironmentBatch&) = delete;

  const BatchOptions& options() const;
  std::size_t agentCount() const;  ///< of each environment
  const ObservationLayout& layout(std::size_t agent = 0) const;
  std::size_t observationSize() const;  ///< number of values per agent: that of the longest observation
  /// It has a digest if BatchOptions::has_digests. The reference is valid until the next episode if worlds are
  /// generated.
  const Environment& environment(std::size_t i) const;
  /// Seed of the generated world of environment i's present episode; 0 before the first reset, and for given worlds.
  std::uint64_t worldSeed(std::size_t i) const;

  /// Gives environment i the seed `seed` + i; its next episode is the first of that seed.
  void setSeed(std::uint64_t seed);
  void setSeed(std::size_t environment, std::uint64_t seed);
  /// Environment i's following episodes begin with these changes, in their order, until others are set. The first
  /// observation is of the changed environment. reset(), or the step that begins an episode, throws ConfigError for one
  /// that is impossible then, as where a random start is in the way; the next call begins the next episode.
  /// @throws ConfigError for EndRun
  void setChanges(std::size_t environment, std::vector<Change> changes);
  /// Starts a new episode in every environment, or in those whose element of `which` is not 0, and writes their
  /// observations only.
  void reset(std::span<float> observations, std::span<const std::uint8_t> which = {});
  /// @param actions environments × agents × 2: set points of speed and turn rate as fractions of the robot's maximum,
  /// clipped to [-1, 1]
  /// @throws std::invalid_argument for an action that is not finite, and for spans of another size; nothing is changed
  void step(std::span<const float> actions, const BatchResults& results);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
