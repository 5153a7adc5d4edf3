#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
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
  /// The same for a copy of the environment in the same state. @throws ConfigError when a controller cannot be copied
  virtual std::unique_ptr<OtherRobots> clone(Environment&) const = 0;
};

/// All that an environment of a batch needs to continue bit for bit in another batch of the same worlds and options,
/// except the memory of OtherRobots.
struct SavedEpisode {
  std::uint64_t seed = 0;
  std::uint64_t number = 0;      ///< of episodes since the seed was set
  std::uint64_t world_seed = 0;  ///< of a generated world; 0: the first one, before the first reset
  std::vector<Change> changes;   ///< with which its episodes begin
  bool is_over = true;           ///< the next step starts the next episode
  std::string state;             ///< state_bytes.h
};

/// Memory of the caller, into which EnvironmentBatch writes the results of a step, in row-major order.
struct BatchResults {
  /// Environments × agents × observationSize(). The end of an agent's observation that is shorter is 0.
  std::span<float> observations;
  std::span<double> rewards;                ///< environments × agents
  std::span<std::uint8_t> terminated;       ///< by environment; 1 when the world was won in this step
  std::span<std::uint8_t> truncated;        ///< by environment; 1 when the episode has reached BatchOptions::steps_max
  std::span<std::int64_t> steps = {};       ///< by environment: number of steps of the episode; empty: not written
  std::span<std::uint8_t> gold_found = {};  ///< by environment: whether a robot has found the gold; empty: not written
};

/// Memory of the caller for pictures of one name, environments × agents × rows × columns in row-major order; empty for
/// layers that they do not have.
struct BatchPictures {
  std::span<std::uint8_t> rgb;  ///< red, green, blue of each pixel
  std::span<float> depth_m;     ///< RawPicture::depth_m
  std::span<std::uint32_t> identity;
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
  /// Number of values of an agent's action: 2, or 3 if any agent of the first world has an omnidirectional drive.
  std::size_t actionSize() const;
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
  /// Ends the episode of environment i: the next step starts the next one.
  void endEpisode(std::size_t environment);

  /// Whether OtherRobots take part in an environment's episode, whose memory save() leaves out.
  bool hasOthers(std::size_t environment) const;
  SavedEpisode save(std::size_t environment) const;
  /// Continues a saved episode in environment i of a batch of the same worlds and options.
  /// @param others of the saved episode, which are copied; null: none take part in it
  /// @throws ConfigError for a state of another world, and for a generated world that cannot be made
  void restore(std::size_t environment, const SavedEpisode& saved, const EnvironmentBatch* others = nullptr);

  /// Starts a new episode in every environment, or in those whose element of `which` is not 0, and writes their
  /// observations only.
  void reset(std::span<float> observations, std::span<const std::uint8_t> which = {});
  /// @param actions environments × agents × actionSize(): set points of speed, turn rate and lateral speed as fractions
  /// of the robot's maximum, clipped to [-1, 1]
  /// @throws std::invalid_argument for an action that is not finite, and for spans of another size; nothing is changed
  void step(std::span<const float> actions, const BatchResults& results);
  /// The pictures among the observations.
  std::span<const ObservedPicture> pictures() const;
  /// Writes those of an index of pictures(), as of the last step or reset; 0 for an agent without the camera, and in a
  /// step in which it takes none.
  /// @throws std::invalid_argument for spans of another size
  void writePictures(std::size_t picture, const BatchPictures& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
