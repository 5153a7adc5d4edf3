#include "simulation.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "base/error_list.h"
#include "environment/state_bytes.h"
#include "file_functions.h"
#include "python_errors.h"
#include "python_released.h"
#include "python_robot.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

namespace py = pybind11;

std::vector<std::string> namesOf(const Fleet& fleet) {
  std::vector<std::string> names;
  for (const auto& robot : fleet.robots) names.push_back(robot.info.name);
  return names;
}

/// Sets a flag during its lifetime.
class Raised {
 public:
  template <typename Flag>
  explicit Raised(Flag& flag) : lower_([&flag] { flag = false; }) {
    flag = true;
  }
  ~Raised() { lower_(); }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;

 private:
  std::function<void()> lower_;
};

/// Turns the exception of a controller in Python into a ControllerError with it as cause. Exceptions that end a
/// program, such as KeyboardInterrupt, are passed on.
[[noreturn]] void throwErrorOf(const py::object& controller, const std::string& robot, py::error_already_set& error) {
  if (!error.matches(PyExc_Exception)) throw std::move(error);
  const std::string name = toBytes(py::str(py::type::of(controller).attr("__name__")));
  const std::string cause = toBytes(py::str(error.type().attr("__name__"))) + ": " + toBytes(py::str(error.value()));
  const std::string text = "robot '" + robot + "': its controller " + name + " raised " + cause;
  // raise_from() takes the cause from the error indicator.
  py::raise_from(error, errorClass("ControllerError").ptr(), text.c_str());
  throw py::error_already_set();
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const PythonWorld> world, Options options)
    : world_(std::move(world)), options_(options.run) {
  LoadedWorld loaded = world_->loaded;
  auto& robots = loaded.fleet.robots;
  const std::string& file = world_->source.file;
  if (robots.empty()) throw ConfigError(file + ": has no robots; add at least one");
  for (std::size_t i = 0; i < robots.size(); ++i) index_[robots[i].info.name] = i;
  for (const auto& [name, controller] : options.named) indexOf(name);
  for (const auto& [name, controller] : options.of_python) {
    of_python_.push_back({indexOf(name), controller, py::object()});
  }
  std::sort(of_python_.begin(), of_python_.end(), [](const auto& a, const auto& b) { return a.robot < b.robot; });

  elsewhere_.assign(robots.size(), 0);
  by_commands_.assign(robots.size(), 0);
  for (const auto& driven : of_python_) elsewhere_[driven.robot] = 1;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (elsewhere_[i]) continue;
    const auto own = options.named.find(robots[i].info.name);
    if (own != options.named.end()) robots[i].controller.edit() = own->second;
    if (own == options.named.end() && !options_.controller.empty()) robots[i].controller.edit() = options_.controller;
    by_commands_[i] = elsewhere_[i] = *robots[i].controller == kNoController ? 1 : 0;
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (elsewhere_[i]) robots[i].controller.edit() = "still";  // which requires no sensors, and is not made
    checkController(controllerOf(*robots[i].controller, ""));
  }
  options_.controller_of_added = options_.controller == kNoController ? "" : options_.controller;
  options_.is_added_elsewhere = [has_none = options_.controller == kNoController](const FleetRobot& robot) {
    return has_none && robot.controller->empty();
  };
  options_.controller.clear();
  ErrorList errors;
  checkControllers(loaded, file, "", errors);
  errors.throwIfAny();
  run_ = std::make_unique<LocalRun>(std::move(loaded), options_, elsewhere_);
  handles_.resize(robotCount());
}

Simulation::Simulation(const Simulation& original, std::unique_ptr<LocalRun> run)
    : world_(original.world_),
      options_(original.options_),
      elsewhere_(original.elsewhere_),
      by_commands_(original.by_commands_),
      run_(std::move(run)),
      handles_(original.robotCount()),
      added_names_(original.added_names_),
      index_(original.index_) {
  const py::object copy = py::module_::import("copy").attr("deepcopy");
  for (const auto& driven : original.of_python_) {
    of_python_.push_back({driven.robot, copy(driven.controller), py::object()});
  }
}

Simulation::~Simulation() {
  try {
    if (recording_) stopRecording();
  } catch (const std::exception&) {  // close() reports it
  }
}

std::shared_ptr<Simulation> Simulation::fork() const {
  return std::shared_ptr<Simulation>(new Simulation(*this, run_->fork(LocalRun::Elsewhere::keep)));
}

std::size_t Simulation::indexOf(const std::string& robot) const {
  const auto found = index_.find(robot);
  if (found != index_.end()) return found->second;
  throw std::invalid_argument("there is no robot '" + robot + "'; the world has " +
                              listed(namesOf(run_ ? environment().fleet() : world_->loaded.fleet)));
}

Robot& Simulation::robot(std::size_t index) {
  if (index >= handles_.size()) throw std::invalid_argument("the robot is not in the state that was restored");
  auto& handle = handles_[index];
  if (!handle) handle = std::make_unique<Handle>(environment(), index);
  return handle->robot;
}

void Simulation::followAdditions() {
  run_->followAdditions();
  const auto& robots = environment().fleet().robots;
  const auto added = environment().state().additions.list();
  const bool has_followed =
      std::equal(added.begin(), added.end(), added_names_.begin(), added_names_.end(),
                 [](const AddRobot& robot, const std::string& name) { return robot.name == name; });
  if (has_followed) return;
  const std::size_t start = robots.size() - added.size();
  for (std::size_t i = start; i < handles_.size(); ++i) index_.erase(added_names_[i - start]);
  added_names_.clear();
  elsewhere_.resize(start);
  by_commands_.resize(start);
  handles_.resize(start);
  for (std::size_t i = start; i < robots.size(); ++i) {
    const bool is_driven = options_.is_added_elsewhere(robots[i]);
    elsewhere_.push_back(is_driven ? 1 : 0);
    by_commands_.push_back(is_driven ? 1 : 0);
    handles_.emplace_back();
    index_[robots[i].info.name] = i;
    added_names_.push_back(robots[i].info.name);
  }
  layouts_.clear();
}

const std::vector<std::unique_ptr<ObservationLayout>>& Simulation::layoutsOf(const std::string& kind) {
  auto [found, is_new] = layouts_.try_emplace(kind);
  if (!is_new) return found->second;
  std::string fault;
  bool is_known = false;
  for (const auto& robot : environment().fleet().robots) {
    try {
      found->second.push_back(std::make_unique<ObservationLayout>(robot.info, std::vector<std::string>{kind}));
      is_known = true;
    } catch (const ConfigError& error) {
      if (fault.empty()) fault = error.what();
      found->second.push_back(nullptr);
    }
  }
  if (!is_known) {
    layouts_.erase(found);
    throw std::invalid_argument(fault);
  }
  return found->second;
}

void Simulation::step(std::uint64_t steps) {
  const Raised in_step(is_in_step_);
  while (steps > 0) {
    runPythonControllers();
    steps -= advance(of_python_.empty() ? steps : 1);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void Simulation::runPythonControllers() {
  for (auto& driven : of_python_) {
    try {
      if (!driven.argument) driven.argument = py::cast(PythonRobot(*this, driven.robot));
      driven.controller.attr("step")(driven.argument);
    } catch (py::error_already_set& error) {
      throwErrorOf(driven.controller, robot(driven.robot).name(), error);
    }
  }
}

/// Takes steps for some milliseconds, so that signals are handled soon. @return their number
std::uint64_t Simulation::advance(std::uint64_t steps_max) {
  using Clock = std::chrono::steady_clock;
  const Raised running(engine_runs_);
  const PythonReleased no_python;
  const auto end = Clock::now() + std::chrono::milliseconds(20);
  std::uint64_t steps = 0;
  do {
    run_->step();
    if (added_names_.size() != environment().state().additions.size()) followAdditions();  // of the world file
    ++steps;
    observe();
  } while (steps < steps_max && Clock::now() < end && !PythonReleased::isInterrupted());
  return steps;
}

void Simulation::observe() {
  if (recording_) recording_->observe(environment());
}

void Simulation::restore(std::string_view bytes) {
  if (recording_)
    throw std::invalid_argument("a recording cannot continue at another time; call stop_recording() before");
  environment().restore(stateFromBytes(*environment().model(), bytes));
  followAdditions();
}

void Simulation::record(const std::filesystem::path& file) {
  if (recording_) throw std::invalid_argument("the simulation is being recorded; call stop_recording() before");
  recording_ = fileFunctions().record(file, world_->source, *run_, options_, elsewhere_);
}

void Simulation::stopRecording() {
  if (!recording_) throw std::invalid_argument("the simulation is not being recorded; call record(file) before");
  const std::unique_ptr<SimulationRecording> ended = std::move(recording_);
  RunSummary summary = RunSummary::of(*run_);
  summary.world = world_->source.file;
  summary.seed = options_.environment.seed;
  summary.ended_by = environment().state().ended ? EndedBy::intervention
                     : environment().allHalted() ? EndedBy::all_halted
                                                 : EndedBy::interrupt;
  ended->finish(environment(), summary);
}

void Simulation::close() {
  if (is_closed_) return;
  is_closed_ = true;
  of_python_.clear();
  if (recording_) stopRecording();
}

void requireUsable(const Simulation& simulation, SimulationAccess access) {
  if (simulation.engine_runs_)
    throw std::runtime_error("another thread is running a step of this simulation; wait until it has ended");
  if (simulation.is_closed_) throw std::invalid_argument("the simulation is closed; make another one");
  if (access == SimulationAccess::structural && simulation.is_in_step_) {
    throw std::runtime_error("a controller cannot change the simulation within a step; do it between two steps");
  }
}

}  // namespace robosim
