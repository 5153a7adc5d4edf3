#include "learning/environment_batch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "base/error_list.h"
#include "base/parallel_executor.h"
#include "base/random.h"
#include "environment/state_bytes.h"
#include "learning/batch_world.h"

namespace robosim {
namespace {

/// An environment of the batch and its present episode.
struct Episode {
  std::unique_ptr<Environment> environment;
  std::shared_ptr<const BatchWorld> world;
  std::unique_ptr<OtherRobots> others;  ///< refers to the environment; null: they stand still
  std::uint64_t seed = 0;
  std::uint64_t number = 0;      ///< of episodes since the seed was set
  std::uint64_t world_seed = 0;  ///< of a generated world
  std::vector<Change> changes;   ///< with which its episodes begin
  bool is_over = true;           ///< the next step starts the next episode
};

double heatOf(const State& state, std::size_t robot, int slot) {
  if (slot < 0) return 0;
  return std::get<Scalar>(state.readings[robot].measurements[static_cast<std::size_t>(slot)]).value;
}

/// Seed of an episode: random numbers of different episodes and environments are independent.
std::uint64_t episodeSeed(std::uint64_t seed, std::uint64_t number) {
  Rng rng(seed, RandomPurpose::scenery, static_cast<std::uint32_t>(number >> 32), 0, number);
  const std::uint64_t high = rng();
  return high << 32 | rng();
}

void requireSize(const char* what, std::size_t size, std::size_t required) {
  if (size == required) return;
  throw std::invalid_argument(std::string(what) + " has " + std::to_string(size) + " elements; it requires " +
                              std::to_string(required));
}

void checkOptions(const BatchOptions& options) {
  if (options.environments == 0) throw ConfigError("a batch requires at least one environment");
  if (options.steps_max == 0) throw ConfigError("an episode requires at least one step");
  if (options.threads < 1) throw ConfigError("a batch requires at least one thread");
  if (options.start_distance_m && !options.has_random_starts) {
    throw ConfigError("a distance of random starts from the gold has no effect without random starts");
  }
  if (options.start_distance_m && !(*options.start_distance_m >= 0 && std::isfinite(*options.start_distance_m))) {
    throw ConfigError("the distance of random starts from the gold is " + std::to_string(*options.start_distance_m) +
                      " m; it must be at least 0, for example 1.5");
  }
  if (!(options.period_s > 0 && options.period_s <= 1)) {
    throw ConfigError("the time step is " + std::to_string(options.period_s) +
                      " s; it must lie in (0, 1] seconds, for example 0.1");
  }
}

}  // namespace

struct EnvironmentBatch::Impl {
  BatchOptions options;
  MakeWorld make_world;    ///< of each episode; null: the environments keep their worlds
  MakeOthers make_others;  ///< null: other robots stand still
  BatchAgents agents;
  std::size_t action_size = 2;
  std::vector<Episode> episodes;
  ParallelExecutor workers;

  Impl(std::vector<LoadedWorld> loaded, BatchOptions the_options, MakeWorld make, MakeOthers others)
      : options(std::move(the_options)),
        make_world(std::move(make)),
        make_others(std::move(others)),
        agents(listAgents(loaded.front(), options)),
        action_size(actionSizeOf(loaded.front().fleet, agents.count())),
        episodes(options.environments),
        workers(options.threads) {
    std::vector<std::shared_ptr<const BatchWorld>> worlds;
    for (auto& world : loaded) worlds.push_back(makeBatchWorld(std::move(world), options, agents));
    workers.forEach(episodes.size(), 1, [&](std::size_t i) {
      episodes[i].seed = options.seed + i;
      enter(episodes[i], worlds[i % worlds.size()]);
    });
  }

  /// Actions have a lateral speed if any agent has one.
  static std::size_t actionSizeOf(const Fleet& fleet, std::size_t agents) {
    const auto end = fleet.robots.begin() + static_cast<std::ptrdiff_t>(agents);
    const bool is_any_omni = std::any_of(fleet.robots.begin(), end, [](const FleetRobot& robot) {
      return robot.info.type->drive.kind == DriveKind::omni;
    });
    return is_any_omni ? 3 : 2;
  }

  void enter(Episode& episode, std::shared_ptr<const BatchWorld> world) const {
    episode.others.reset();
    episode.environment = std::make_unique<Environment>(world->model, world->start);
    if (!options.has_digests) {
      episode.environment->senseOnly([&](std::size_t robot, std::size_t slot) { return isRead(*world, robot, slot); });
    }
    episode.environment->setRobotCheck([](const FleetRobot&) {
      return "learning environments have arrays of a fixed number of robots; give the world the robot, and take it out "
             "until it is needed";
    });
    episode.world = std::move(world);
  }

  /// Whether an observation, a reward, a controller or another sensor that is read reads the sensor of a robot.
  bool isRead(const BatchWorld& world, std::size_t robot, std::size_t slot) const {
    if (robot >= agents.count()) return make_others != nullptr;
    const auto parts = agents.layouts[robot].parts();
    if (std::any_of(parts.begin(), parts.end(), [&](const ObservationPart& part) { return part.slot == slot; }) ||
        (options.reward.heat != 0 && world.heat_slots[robot] == static_cast<int>(slot))) {
      return true;
    }
    const auto& sensors = world.model->fleet.robots[robot].model->sensors;
    for (std::size_t other = slot + 1; other < sensors.size(); ++other) {
      if (sensors[other]->slotRead() == slot && isRead(world, robot, other)) return true;
    }
    return false;
  }

  void startEpisode(Episode& episode) const {
    episode.is_over = true;  // also when the world cannot be made
    const std::uint64_t seed = episodeSeed(episode.seed, episode.number++);
    if (make_world) {
      enter(episode, makeBatchWorld(make_world(seed), options, agents));
      episode.world_seed = seed;
    }
    State start = episode.world->start;
    if (episode.world->random_starts) start.world_from_robot = episode.world->random_starts->draw(seed);
    start.seed = seed;
    episode.others.reset();
    if (!episode.changes.empty()) start = changed(episode, start);
    episode.environment->restart(start);
    if (make_others) episode.others = make_others(*episode.environment, agents.count());
    episode.is_over = false;
  }

  /// The start of an episode with its changes, which are no interventions in it.
  State changed(const Episode& episode, const State& start) const {
    Environment& environment = *episode.environment;
    environment.restore(start);
    for (const Change& change : episode.changes) {
      if (const std::string fault = environment.apply({"learning", change}); !fault.empty()) {
        throw ConfigError("environment " + std::to_string(&episode - episodes.data()) +
                          ": an episode cannot begin with " + changeText(change) + ": " + fault);
      }
    }
    State result = environment.state();
    result.interventions.clear();
    result.interventions_applied = 0;
    result.digest = start.digest;
    return result;
  }

  void observe(std::size_t i, std::span<float> observations) const {
    const State& state = episodes[i].environment->state();
    for (std::size_t agent = 0; agent < agents.count(); ++agent) {
      const ObservationLayout& layout = agents.layouts[agent];
      const auto out = observations.subspan((i * agents.count() + agent) * agents.size, agents.size);
      layout.write(state, agent, out);
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(layout.size()), out.end(), 0.f);
    }
  }

  void step(std::size_t i, std::span<const float> actions, const BatchResults& results) {
    advance(i, actions, results);
    observe(i, results.observations);
    const State& state = episodes[i].environment->state();
    if (!results.steps.empty()) results.steps[i] = static_cast<std::int64_t>(state.time.step);
    if (!results.gold_found.empty()) results.gold_found[i] = state.found || state.won ? 1 : 0;
  }

  /// Reward of the present reading of an agent's heat sensor. Without a weight the reading, a cache miss, is not read.
  double heatReward(std::size_t i, std::size_t agent) const {
    if (options.reward.heat == 0) return 0;
    const Episode& episode = episodes[i];
    return options.reward.heat * heatOf(episode.environment->state(), agent, episode.world->heat_slots[agent]);
  }

  /// Takes the step of an environment, or begins its next episode.
  void advance(std::size_t i, std::span<const float> actions, const BatchResults& results) {
    Episode& episode = episodes[i];
    const auto rewards = results.rewards.subspan(i * agents.count(), agents.count());
    results.terminated[i] = results.truncated[i] = 0;
    if (episode.is_over) {
      startEpisode(episode);
      std::fill(rewards.begin(), rewards.end(), 0.0);
      return;
    }
    Environment& environment = *episode.environment;
    const State& state = environment.state();
    const RewardWeights& weights = options.reward;
    for (std::size_t agent = 0; agent < agents.count(); ++agent) {
      const float* action = &actions[(i * agents.count() + agent) * action_size];
      const MotionLimits& limit = episode.world->model->fleet.robots[agent].info.type->limits;
      Command command;
      command.speed_mps = std::clamp(static_cast<double>(action[0]), -1.0, 1.0) * limit.speed_max_mps;
      command.turn_radps = std::clamp(static_cast<double>(action[1]), -1.0, 1.0) * limit.turn_max_radps;
      if (action_size > 2)
        command.lateral_mps = std::clamp(static_cast<double>(action[2]), -1.0, 1.0) * limit.lateral_max_mps;
      environment.setCommand(agent, command);
      environment.checkWin(agent);
      rewards[agent] = -heatReward(i, agent);
    }
    if (episode.others) episode.others->act();
    environment.step();
    const bool is_won = state.winner().has_value();
    for (std::size_t agent = 0; agent < agents.count(); ++agent) {
      rewards[agent] += heatReward(i, agent) + weights.win * (is_won ? 1 : 0) +
                        weights.forward * state.last_motion[agent].length_m + weights.stall * state.stalled[agent] +
                        weights.step;
    }
    results.terminated[i] = is_won ? 1 : 0;
    results.truncated[i] = !is_won && state.time.step >= options.steps_max ? 1 : 0;
    episode.is_over = results.terminated[i] || results.truncated[i];
  }

  void checkActions(std::span<const float> actions) const {
    const auto bad = std::find_if(actions.begin(), actions.end(), [](float a) { return !std::isfinite(a); });
    if (bad == actions.end()) return;
    const auto index = static_cast<std::size_t>(bad - actions.begin());
    throw std::invalid_argument("the action of agent " + std::to_string(index / action_size % agents.count()) +
                                " in environment " + std::to_string(index / action_size / agents.count()) +
                                " is not finite; actions are fractions in [-1, 1]");
  }
};

EnvironmentBatch::EnvironmentBatch(std::vector<LoadedWorld> worlds, BatchOptions options, MakeOthers others) {
  checkOptions(options);
  if (worlds.empty()) throw ConfigError("a batch requires at least one world");
  impl_ = std::make_unique<Impl>(std::move(worlds), std::move(options), nullptr, std::move(others));
}

EnvironmentBatch::EnvironmentBatch(MakeWorld make, BatchOptions options, MakeOthers others) {
  checkOptions(options);
  std::vector<LoadedWorld> first;
  first.push_back(make(episodeSeed(options.seed, 0)));
  impl_ = std::make_unique<Impl>(std::move(first), std::move(options), std::move(make), std::move(others));
}

EnvironmentBatch::~EnvironmentBatch() = default;

const BatchOptions& EnvironmentBatch::options() const { return impl_->options; }
std::size_t EnvironmentBatch::agentCount() const { return impl_->agents.count(); }
const ObservationLayout& EnvironmentBatch::layout(std::size_t agent) const { return impl_->agents.layouts.at(agent); }
std::size_t EnvironmentBatch::actionSize() const { return impl_->action_size; }
std::size_t EnvironmentBatch::observationSize() const { return impl_->agents.size; }
const Environment& EnvironmentBatch::environment(std::size_t i) const { return *impl_->episodes.at(i).environment; }

std::uint64_t EnvironmentBatch::worldSeed(std::size_t i) const { return impl_->episodes.at(i).world_seed; }

void EnvironmentBatch::setSeed(std::uint64_t seed) {
  for (std::size_t i = 0; i < impl_->episodes.size(); ++i) setSeed(i, seed + i);
}

void EnvironmentBatch::setSeed(std::size_t environment, std::uint64_t seed) {
  Episode& episode = impl_->episodes.at(environment);
  episode.seed = seed;
  episode.number = 0;
}

void EnvironmentBatch::setChanges(std::size_t environment, std::vector<Change> changes) {
  for (const Change& change : changes) {
    if (std::holds_alternative<EndRun>(change)) {
      throw ConfigError(changeText(change) + ": an episode cannot begin with its end; leave it out");
    }
  }
  impl_->episodes.at(environment).changes = std::move(changes);
}

void EnvironmentBatch::endEpisode(std::size_t environment) { impl_->episodes.at(environment).is_over = true; }

bool EnvironmentBatch::hasOthers(std::size_t environment) const {
  const Episode& episode = impl_->episodes.at(environment);
  return episode.others && !episode.is_over;
}

SavedEpisode EnvironmentBatch::save(std::size_t environment) const {
  const Episode& episode = impl_->episodes.at(environment);
  const Environment& of = *episode.environment;
  return {episode.seed,    episode.number,  episode.world_seed,
          episode.changes, episode.is_over, toBytes(*of.model(), of.state())};
}

void EnvironmentBatch::restore(std::size_t environment, const SavedEpisode& saved, const EnvironmentBatch* others) {
  Episode& episode = impl_->episodes.at(environment);
  if (impl_->make_world && saved.world_seed != 0) {
    impl_->enter(episode, makeBatchWorld(impl_->make_world(saved.world_seed), impl_->options, impl_->agents));
  }
  Environment& of = *episode.environment;
  of.restore(stateFromBytes(*of.model(), saved.state));
  episode.seed = saved.seed;
  episode.number = saved.number;
  episode.world_seed = saved.world_seed;
  episode.changes = saved.changes;
  episode.is_over = saved.is_over;
  episode.others.reset();
  if (others && others->hasOthers(environment)) {
    episode.others = others->impl_->episodes.at(environment).others->clone(of);
  }
}

void EnvironmentBatch::reset(std::span<float> observations, std::span<const std::uint8_t> which) {
  requireSize("the array of observations", observations.size(),
              impl_->episodes.size() * agentCount() * observationSize());
  if (!which.empty()) requireSize("the selection of environments", which.size(), impl_->episodes.size());
  impl_->workers.forEach(impl_->episodes.size(), 4, [&](std::size_t i) {
    if (!which.empty() && !which[i]) return;
    impl_->startEpisode(impl_->episodes[i]);
    impl_->observe(i, observations);
  });
}

void EnvironmentBatch::step(std::span<const float> actions, const BatchResults& results) {
  const std::size_t environments = impl_->episodes.size();
  const std::size_t robots = environments * agentCount();
  requireSize("the array of actions", actions.size(), robots * actionSize());
  requireSize("the array of observations", results.observations.size(), robots * observationSize());
  requireSize("the array of rewards", results.rewards.size(), robots);
  requireSize("the array of terminations", results.terminated.size(), environments);
  requireSize("the array of truncations", results.truncated.size(), environments);
  if (!results.steps.empty()) requireSize("the array of steps", results.steps.size(), environments);
  if (!results.gold_found.empty()) requireSize("the array of gold found", results.gold_found.size(), environments);
  impl_->checkActions(actions);
  impl_->workers.forEach(environments, 4, [&](std::size_t i) { impl_->step(i, actions, results); });
}

std::span<const ObservedPicture> EnvironmentBatch::pictures() const { return impl_->agents.pictures; }

void EnvironmentBatch::writePictures(std::size_t picture, const BatchPictures& out) {
  const ObservedPicture& of = impl_->agents.pictures.at(picture);
  const std::size_t agents = impl_->agents.count(), pixels = std::size_t{of.camera.width_px} * of.camera.height_px;
  const auto& [has_rgb, has_depth, has_identity] = of.camera.layers;
  const std::size_t all = impl_->episodes.size() * agents * pixels;
  requireSize("the array of colours", out.rgb.size(), has_rgb ? 3 * all : 0);
  requireSize("the array of depths", out.depth_m.size(), has_depth ? all : 0);
  requireSize("the array of identities", out.identity.size(), has_identity ? all : 0);
  const auto copy = [&](const auto& from, const auto& to, std::size_t at, std::size_t size) {
    if (to.empty()) return;
    const auto begin = to.begin() + static_cast<std::ptrdiff_t>(at * size);
    if (from.size() == size) {
      std::copy(from.begin(), from.end(), begin);
    } else {
      std::fill_n(begin, size, 0);
    }
  };
  impl_->workers.forEach(impl_->episodes.size() * agents, 1, [&](std::size_t i) {
    static const RawPicture kNoPicture;
    const std::size_t agent = i % agents;
    const RawPicture* raw = nullptr;
    if (of.slots[agent] != ObservedPicture::kNone) {
      const auto& readings = impl_->episodes[i / agents].environment->state().readings[agent];
      raw = std::get<Image>(readings.measurements[of.slots[agent]]).raw.get();
    }
    const RawPicture& from = raw ? *raw : kNoPicture;
    copy(from.rgb, out.rgb, i, 3 * pixels);
    copy(from.depth_m, out.depth_m, i, pixels);
    copy(from.identity, out.identity, i, pixels);
  });
}

}  // namespace robosim
