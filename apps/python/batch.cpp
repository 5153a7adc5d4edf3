#include "batch.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "array_arguments.h"
#include "generated_world.h"
#include "learning/environment_batch.h"
#include "other_robots.h"
#include "python_errors.h"
#include "python_released.h"
#include "python_world.h"
#include "whole_number.h"
#include "world/intervention.h"

namespace robosim {
namespace {

namespace py = pybind11;

/// A batch that one thread at a time may use.
class PythonBatch {
 public:
  /// @param worlds std::vector<LoadedWorld>, or EnvironmentBatch::MakeWorld
  template <typename Worlds>
  PythonBatch(Worlds worlds, BatchOptions options, EnvironmentBatch::MakeOthers others)
      : batch_(std::move(worlds), std::move(options), std::move(others)) {}

  const EnvironmentBatch& batch() const { return batch_; }
  py::ssize_t environments() const { return static_cast<py::ssize_t>(batch_.options().environments); }
  py::ssize_t agents() const { return static_cast<py::ssize_t>(batch_.agentCount()); }
  py::ssize_t actionSize() const { return static_cast<py::ssize_t>(batch_.actionSize()); }
  py::ssize_t size() const { return static_cast<py::ssize_t>(batch_.observationSize()); }

  /// Calls use(batch) without Python's lock.
  template <typename Use>
  void exclusively(const Use& use) {
    if (is_used_.exchange(true)) {
      throw std::runtime_error("another thread is using these environments; wait until it has ended");
    }
    const std::unique_ptr<std::atomic<bool>, void (*)(std::atomic<bool>*)> end(&is_used_,
                                                                               [](auto* used) { *used = false; });
    const PythonReleased no_python;
    use(batch_);
  }

 private:
  EnvironmentBatch batch_;
  std::atomic<bool> is_used_ = false;
};

/// @throws pybind11::type_error for an unknown weight, std::invalid_argument for one that is not finite
RewardWeights readWeights(const py::dict& given) {
  RewardWeights weights;
  const std::pair<const char*, double*> known[] = {{"win", &weights.win},
                                                   {"forward", &weights.forward},
                                                   {"heat", &weights.heat},
                                                   {"stall", &weights.stall},
                                                   {"step", &weights.step}};
  if (!given.empty()) weights.win = 0;
  for (const auto& [key, value] : given) {
    const std::string name = toBytes(py::str(key));
    const auto* found =
        std::find_if(std::begin(known), std::end(known), [&](const auto& of) { return name == of.first; });
    if (found == std::end(known)) {
      throw py::type_error("there is no reward '" + name + "'; rewards are win, forward, heat, stall, step");
    }
    if (!py::isinstance<py::float_>(value) && !PyIndex_Check(value.ptr())) {
      throw py::type_error("the weight of the reward '" + name + "' must be a number, not " +
                           py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>() +
                           "; for example {\"" + name + "\": 0.5}");
    }
    *found->second = value.cast<double>();
    requireFinite("the weight of a reward", *found->second);
  }
  return weights;
}

std::unique_ptr<PythonBatch> makeBatch(const std::vector<std::shared_ptr<PythonWorld>>& worlds, BatchOptions options,
                                       EnvironmentBatch::MakeOthers others) {
  std::vector<LoadedWorld> loaded;
  for (const auto& world : worlds) {
    loaded.push_back(world->loaded);
    if (others && options.agents > 0) checkOtherRobots(world->loaded, options.agents);
  }
  return std::make_unique<PythonBatch>(std::move(loaded), std::move(options), std::move(others));
}

/// Seed of each environment's generated world: uint64, shape (num_envs,).
py::array_t<std::uint64_t> worldSeedsOf(const PythonBatch& of) {
  py::array_t<std::uint64_t> seeds(of.environments());
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    seeds.mutable_at(i) = of.batch().worldSeed(static_cast<std::size_t>(i));
  }
  return seeds;
}

/// Steps since the beginning of each environment's episode: int64, shape (num_envs,).
py::array_t<std::int64_t> stepsOf(const PythonBatch& of) {
  py::array_t<std::int64_t> steps(of.environments());
  std::int64_t* out = steps.mutable_data();
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    out[i] = static_cast<std::int64_t>(of.batch().environment(static_cast<std::size_t>(i)).state().time.step);
  }
  return steps;
}

/// Poses of all robots of an environment: float64, shape (robots, 3).
py::array_t<double> episodePosesOf(const PythonBatch& of, std::size_t environment) {
  const auto& poses = of.batch().environment(environment).state().world_from_robot;
  py::array_t<double> all(std::vector<py::ssize_t>{static_cast<py::ssize_t>(poses.size()), 3});
  double* out = all.mutable_data();
  for (const auto& pose : poses) {
    for (const double value : {pose.x, pose.y, pose.phi}) *out++ = value;
  }
  return all;
}

/// Poses of all robots of all environments: float64, shape (num_envs, robots, 3).
/// @throws std::invalid_argument for environments with different numbers of robots
py::array_t<double> allPosesOf(const PythonBatch& of) {
  const auto robots = static_cast<py::ssize_t>(of.batch().environment(0).robotCount());
  py::array_t<double> all(std::vector<py::ssize_t>{of.environments(), robots, 3});
  double* out = all.mutable_data();
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    const auto& poses = of.batch().environment(static_cast<std::size_t>(i)).state().world_from_robot;
    if (static_cast<py::ssize_t>(poses.size()) != robots) {
      throw std::invalid_argument("the environments have different numbers of robots");
    }
    for (const auto& pose : poses) {
      for (const double value : {pose.x, pose.y, pose.phi}) *out++ = value;
    }
  }
  return all;
}

/// Positions of the movable objects of all environments: float64, shape (num_envs, objects, 2).
/// @throws std::invalid_argument for environments with different numbers of them
py::array_t<double> movablePositionsOf(const PythonBatch& of) {
  std::vector<double> positions;
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    const std::size_t before = positions.size();
    for (const WorldObject& object : of.batch().environment(static_cast<std::size_t>(i)).objects()) {
      if (!object.movable) continue;
      positions.push_back(object.body.world_from_body.x);
      positions.push_back(object.body.world_from_body.y);
    }
    if (i > 0 && (positions.size() - before) * static_cast<std::size_t>(i) != before) {
      throw std::invalid_argument("the environments have different numbers of movable objects");
    }
  }
  py::array_t<double> all(std::vector<py::ssize_t>{
      of.environments(), static_cast<py::ssize_t>(positions.size()) / 2 / of.environments(), 2});
  std::copy(positions.begin(), positions.end(), all.mutable_data());
  return all;
}

/// All environments as tuples of Python, for restore(). @param with_others whether copyOthers() follows
/// @throws std::invalid_argument when controllers take part in an episode, unless with_others
py::list saveBatch(const PythonBatch& of, bool with_others) {
  py::list all;
  for (std::size_t i = 0; i < of.batch().options().environments; ++i) {
    if (!with_others && of.batch().hasOthers(i)) {
      throw std::invalid_argument(
          "environment " + std::to_string(i) +
          " cannot be pickled within an episode: controllers drive its other robots, and their memory has no form as "
          "bytes; pickle it before the first reset(), use others=\"still\", or copy.deepcopy()");
    }
    const SavedEpisode saved = of.batch().save(i);
    py::list changes;
    for (const Change& change : saved.changes) changes.append(toPython(changeText(change)));
    all.append(
        py::make_tuple(saved.seed, saved.number, saved.world_seed, changes, saved.is_over, py::bytes(saved.state)));
  }
  return all;
}

/// @param from the batch of which the environments are, whose other robots are copied; null: they have none
void restoreBatch(PythonBatch& of, const py::list& saved, const PythonBatch* from) {
  if (static_cast<py::ssize_t>(saved.size()) != of.environments()) {
    throw std::invalid_argument("the saved state is of " + std::to_string(saved.size()) + " environments, not of " +
                                std::to_string(of.environments()));
  }
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const auto one = saved[i].cast<py::tuple>();
    SavedEpisode episode{.seed = one[0].cast<std::uint64_t>(),
                         .number = one[1].cast<std::uint64_t>(),
                         .world_seed = one[2].cast<std::uint64_t>(),
                         .changes = {},
                         .is_over = one[4].cast<bool>(),
                         .state = one[5].cast<std::string>()};
    for (const auto& change : one[3]) {
      episode.changes.push_back(parseChange(toBytes(py::reinterpret_borrow<py::str>(change)), "saved environment"));
    }
    of.exclusively([&](EnvironmentBatch& batch) { batch.restore(i, episode, from ? &from->batch() : nullptr); });
  }
}

/// Name of the winner of each environment: object, shape (num_envs,); None without one.
py::array winnersOf(const PythonBatch& of) {
  py::list winners;
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    const Environment& environment = of.batch().environment(static_cast<std::size_t>(i));
    const auto winner = environment.state().winner();
    winners.append(winner ? py::object(toPython(environment.robotNames()[*winner])) : py::none());
  }
  return py::module_::import("numpy").attr("array")(winners, py::arg("dtype") = "object");
}

/// Whether the gold was found in each environment's episode: bool, shape (num_envs,). By an agent, which then has won,
/// or by a robot with a controller.
py::array_t<bool> goldFoundIn(const PythonBatch& of) {
  py::array_t<bool> found(of.environments());
  for (py::ssize_t i = 0; i < of.environments(); ++i) {
    const State& state = of.batch().environment(static_cast<std::size_t>(i)).state();
    found.mutable_at(i) = state.found || state.won;
  }
  return found;
}

/// Bounds of each agent's observation: float32, shape (agents, size); 0 beyond its own size.
py::array_t<float> boundsOf(const PythonBatch& of, std::vector<float> ObservationPart::*bound) {
  py::array_t<float> bounds(std::vector<py::ssize_t>{of.agents(), of.size()});
  std::fill_n(bounds.mutable_data(), bounds.size(), 0.f);
  for (py::ssize_t agent = 0; agent < of.agents(); ++agent) {
    float* out = bounds.mutable_data() + agent * of.size();  // also of observations without numbers
    for (const auto& part : of.batch().layout(static_cast<std::size_t>(agent)).parts()) {
      out = std::copy((part.*bound).begin(), (part.*bound).end(), out);
    }
  }
  return bounds;
}

/// Name, begin and end of each part of each agent's observation.
py::list partsOf(const PythonBatch& of) {
  py::list all;
  for (py::ssize_t agent = 0; agent < of.agents(); ++agent) {
    py::list parts;
    std::size_t begin = 0;
    for (const auto& part : of.batch().layout(static_cast<std::size_t>(agent)).parts()) {
      parts.append(py::make_tuple(part.name, begin, begin + part.size));
      begin += part.size;
    }
    all.append(parts);
  }
  return all;
}

py::list agentNames(const PythonBatch& of) {
  py::list names;
  for (std::size_t i = 0; i < of.batch().agentCount(); ++i) {
    names.append(toPython(of.batch().environment(0).robotNames()[i]));
  }
  return names;
}

std::span<float> observationsOf(const PythonBatch& of, py::array& array) {
  const auto shape = std::vector<py::ssize_t>{of.environments(), of.agents(), of.size()};
  return {resultsOf<float>("observations", array, shape), static_cast<std::size_t>(array.size())};
}

void reset(PythonBatch& of, py::array observations, const py::object& mask) {
  const auto out = observationsOf(of, observations);
  std::vector<std::uint8_t> which;
  if (!mask.is_none()) {
    const auto given = py::array::ensure(mask);
    if (!given || !py::dtype::of<bool>().equal(given.dtype())) {
      PyErr_Clear();
      throw py::type_error("the reset mask must be an array of bool");
    }
    requireShape("the elements of the reset mask", given, {of.environments()});
    const auto selected = py::array_t<bool>(given);
    for (py::ssize_t i = 0; i < of.environments(); ++i) which.push_back(selected.at(i) ? 1 : 0);
  }
  of.exclusively([&](EnvironmentBatch& batch) { batch.reset(out, which); });
}

/// @return stepsOf() and goldFoundIn() after the step, and whether any episode has ended in it: in one call, because a
/// look at each environment costs cache misses
py::tuple step(PythonBatch& of, const py::object& actions, py::array observations, py::array rewards,
               py::array terminated, py::array truncated) {
  const auto given = numbersOf<float>("actions", actions, {of.environments(), of.agents(), of.actionSize()});
  const auto environments = static_cast<std::size_t>(of.environments());
  const auto flags = [&](const char* what, py::array& array) {
    return std::span(reinterpret_cast<std::uint8_t*>(resultsOf<bool>(what, array, {of.environments()})), environments);
  };
  py::array_t<std::int64_t> steps(of.environments());
  py::array_t<bool> gold_found(of.environments());
  const BatchResults results{observationsOf(of, observations),
                             {resultsOf<double>("rewards", rewards, {of.environments(), of.agents()}),
                              static_cast<std::size_t>(rewards.size())},
                             flags("terminations", terminated),
                             flags("truncations", truncated),
                             {steps.mutable_data(), environments},
                             flags("gold_found", gold_found)};
  const std::span<const float> of_agents(given.data(), static_cast<std::size_t>(given.size()));
  of.exclusively([&](EnvironmentBatch& batch) { batch.step(of_agents, results); });
  const auto any = [](std::span<const std::uint8_t> of_all) {
    return std::find(of_all.begin(), of_all.end(), 1) != of_all.end();
  };
  return py::make_tuple(std::move(steps), std::move(gold_found), any(results.terminated) || any(results.truncated));
}

/// Name, height, width, layers and range of the depths of each picture among the observations.
py::list picturesOf(const PythonBatch& of) {
  py::list all;
  for (const ObservedPicture& picture : of.batch().pictures()) {
    all.append(py::make_tuple(toPython(picture.name), picture.camera.height_px, picture.camera.width_px,
                              picture.camera.layers.names(), picture.range_max_m));
  }
  return all;
}

/// @param rgb, depth, identity arrays for the layers that the picture has; None for others
void writePictures(PythonBatch& of, std::size_t index, std::optional<py::array> rgb, std::optional<py::array> depth,
                   std::optional<py::array> identity) {
  const ObservedPicture& picture = of.batch().pictures()[index];
  std::vector<py::ssize_t> shape{of.environments(), of.agents(), py::ssize_t{picture.camera.height_px},
                                 py::ssize_t{picture.camera.width_px}};
  BatchPictures out;
  const auto size = [](const py::array& array) { return static_cast<std::size_t>(array.size()); };
  if (depth) out.depth_m = {resultsOf<float>("depths", *depth, shape), size(*depth)};
  if (identity) out.identity = {resultsOf<std::uint32_t>("identities", *identity, shape), size(*identity)};
  shape.push_back(3);
  if (rgb) out.rgb = {resultsOf<std::uint8_t>("colours", *rgb, shape), size(*rgb)};
  of.exclusively([&](EnvironmentBatch& batch) { batch.writePictures(index, out); });
}

}  // namespace

void bindBatch(py::module_& module) {
  using Worlds = std::variant<std::shared_ptr<PythonGenerator>, std::vector<std::shared_ptr<PythonWorld>>>;
  const auto make = [](const Worlds& worlds, std::size_t num_envs, std::size_t agents,
                       std::vector<std::string> observations, const py::dict& reward, double period_s,
                       std::uint32_t max_steps, bool random_starts, std::optional<double> start_distance_m, int threads,
                       std::uint64_t seed, bool has_controllers) {
    BatchOptions options{.environments = num_envs,
                         .agents = agents,
                         .observations = std::move(observations),
                         .reward = readWeights(reward),
                         .period_s = period_s,
                         .steps_max = max_steps,
                         .has_random_starts = random_starts,
                         .start_distance_m = start_distance_m,
                         .threads = threads,
                         .seed = seed};
    const PythonReleased no_python;
    const EnvironmentBatch::MakeOthers others = has_controllers ? otherRobots : EnvironmentBatch::MakeOthers();
    if (const auto* given = std::get_if<std::vector<std::shared_ptr<PythonWorld>>>(&worlds)) {
      return makeBatch(*given, std::move(options), others);
    }
    return std::make_unique<PythonBatch>(
        EnvironmentBatch::MakeWorld(std::get<std::shared_ptr<PythonGenerator>>(worlds)->forEpisodes()),
        std::move(options), others);
  };
  py::class_<PythonBatch>(module, "_Batch")
      .def(py::init(make), py::arg("worlds"), py::arg("num_envs"), py::arg("agents"), py::arg("observations"),
           py::arg("reward"), py::arg("period_s"), py::arg("max_steps"), py::arg("random_starts"),
           py::arg("start_distance_m"), py::arg("threads"), py::arg("seed"), py::arg("controllers"))
      .def_property_readonly("agents", &PythonBatch::agents)
      .def_property_readonly("action_size", &PythonBatch::actionSize)
      .def_property_readonly("size", &PythonBatch::size)
      .def_property_readonly("agent_names", agentNames)
      .def_property_readonly("parts", partsOf)
      .def_property_readonly("low", [](const PythonBatch& of) { return boundsOf(of, &ObservationPart::low); })
      .def_property_readonly("high", [](const PythonBatch& of) { return boundsOf(of, &ObservationPart::high); })
      .def_property_readonly("world_seeds", worldSeedsOf)
      .def_property_readonly("steps", stepsOf)
      .def("poses", episodePosesOf)
      .def_property_readonly("all_poses", allPosesOf)
      .def_property_readonly("movable_positions", movablePositionsOf)
      .def("save", saveBatch, py::arg("with_others") = false)
      .def("restore", restoreBatch, py::arg("saved"),
           py::arg("others_of").none(true) = static_cast<const PythonBatch*>(nullptr))
      .def("end_episodes",
           [](PythonBatch& of, const py::array_t<bool>& which) {
             requireShape("the elements of which", which, {of.environments()});
             for (py::ssize_t i = 0; i < of.environments(); ++i) {
               if (!which.at(i)) continue;
               of.exclusively([&](EnvironmentBatch& batch) { batch.endEpisode(static_cast<std::size_t>(i)); });
             }
           })
      .def_property_readonly("winners", winnersOf)
      .def_property_readonly("gold_found", goldFoundIn)
      .def_property_readonly("period_s", [](const PythonBatch& of) { return of.batch().options().period_s; })
      .def("set_seed",
           [](PythonBatch& of, std::size_t environment, Seed seed) {
             of.exclusively([&](EnvironmentBatch& batch) { batch.setSeed(environment, seed); });
           })
      .def("set_interventions",
           [](PythonBatch& of, std::size_t environment, const std::vector<std::string>& elements) {
             std::vector<Change> changes;
             for (const std::string& element : elements) changes.push_back(parseChange(element, "intervention"));
             of.exclusively([&](EnvironmentBatch& batch) { batch.setChanges(environment, std::move(changes)); });
           })
      .def("reset", reset, py::arg("observations"), py::arg("mask") = py::none())
      .def("step", step)
      .def_property_readonly("pictures", picturesOf)
      .def("write_pictures", writePictures, py::arg("index"), py::arg("rgb").none(true), py::arg("depth").none(true),
           py::arg("identity").none(true));
}

}  // namespace robosim
