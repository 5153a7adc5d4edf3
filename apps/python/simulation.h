#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "control/robot.h"
#include "environment/local_hardware.h"
#include "learning/observation_layout.h"
#include "python_world.h"
#include "run/local_run.h"
#include "run/outputs/simulation_recording.h"

namespace robosim {

/// Name that stands for no controller: the robot is driven by commands.
constexpr const char* kNoController = "none";

/// Kind of access to a simulation.
enum class SimulationAccess {
  read,
  command,    ///< also within a step of a controller
  structural  ///< changes more than commands: refused within a step
};

/// A run whose robots are driven by controllers of this program, by controllers in Python, or by commands.
///
/// Only one thread may use it at a time; while step() has released Python's lock, other uses are refused
/// (requireUsable()).
class Simulation : public std::enable_shared_from_this<Simulation> {
 public:
  struct Options {
    RunOptions run;  ///< `controller` of robots for which there is no other; empty: as given in the world
    std::map<std::string, std::string> named;             ///< controllers by robot: names of this program's, or "none"
    std::map<std::string, pybind11::object> of_python{};  ///< controllers by robot: objects with a method step(robot)
  };

  /// @throws ConfigError for a world without robots, unknown controllers, and sensors that controllers lack;
  /// std::invalid_argument for an unknown robot
  Simulation(std::shared_ptr<const PythonWorld> world, Options options);
  /// Finishes the recording; errors are ignored.
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// A simulation that continues from the present state, with copies of all controllers (Python's by copy.deepcopy()).
  /// It records nothing.
  std::shared_ptr<Simulation> fork() const;

  /// Takes steps. Python's lock is released meanwhile, except for controllers in Python, and signals are handled.
  /// @throws ControllerError, RecordingError, pybind11::error_already_set (such as KeyboardInterrupt); the steps before
  /// remain taken, and the simulation stays usable
  void step(std::uint64_t steps);

  const PythonWorld& world() const { return *world_; }
  const Environment& environment() const { return run_->environment(); }
  Environment& environment() { return run_->environment(); }
  std::size_t robotCount() const { return environment().robotCount(); }
  /// Index of a robot. @throws std::invalid_argument for an unknown one
  std::size_t indexOf(const std::string& robot) const;
  /// Whether a robot is driven by commands.
  bool isDrivenByCommands(std::size_t robot) const { return by_commands_[robot] != 0; }
  /// Whether it is driven by commands or a controller in Python.
  bool isDrivenFromPython(std::size_t robot) const { return elsewhere_[robot] != 0; }
  /// The interface of a robot's controller.
  Robot& robot(std::size_t index);
  /// How to write a robot's readings of a kind to an array; null for a robot without such a sensor.
  const std::vector<std::unique_ptr<ObservationLayout>>& layoutsOf(const std::string& kind);

  /// After interventions and restored states, which may have added robots or have others.
  void followAdditions();
  void restore(std::string_view bytes);  ///< @throws ConfigError
  /// Records the present state and all further steps. @throws ConfigError, RecordingError
  void record(const std::filesystem::path& file);
  void stopRecording();  ///< @throws RecordingError
  bool isRecording() const { return recording_ != nullptr; }

  /// Ends the recording and makes every further use fail, except of arrays, which keep their last values.
  void close();
  bool isClosed() const { return is_closed_; }

 private:
  friend void requireUsable(const Simulation&, SimulationAccess);
  struct Handle {
    LocalHardware hardware;
    Robot robot;
    Handle(Environment& environment, std::size_t i) : hardware(environment, i), robot(hardware) {}
  };
  struct PythonDriven {
    std::size_t robot;
    pybind11::object controller;
    pybind11::object argument;  ///< of its step(): the Python object of its robot; made in the first step
  };

  Simulation(const Simulation& original, std::unique_ptr<LocalRun> run);
  void runPythonControllers();
  std::uint64_t advance(std::uint64_t steps_max);
  void observe();

  std::shared_ptr<const PythonWorld> world_;
  RunOptions options_;
  std::vector<std::uint8_t> elsewhere_;    ///< by robot: not driven by LocalRun
  std::vector<std::uint8_t> by_commands_;  ///< by robot
  std::unique_ptr<LocalRun> run_;
  std::vector<PythonDriven> of_python_;
  std::vector<std::unique_ptr<Handle>> handles_;  ///< by robot; null until used
  std::vector<std::string> added_names_;          ///< of the robots that have been added, the last ones
  std::map<std::string, std::size_t> index_;
  std::map<std::string, std::vector<std::unique_ptr<ObservationLayout>>> layouts_;
  std::unique_ptr<SimulationRecording> recording_;
  std::atomic<bool> engine_runs_ = false;
  bool is_in_step_ = false;
  bool is_closed_ = false;
};

/// Checks, before an access, that no other thread runs the engine.
/// @throws std::invalid_argument after close(); std::runtime_error while another thread runs a step, and for a
/// structural access within one
void requireUsable(const Simulation& simulation, SimulationAccess access);

void bindSimulation(pybind11::module_& module);

}  // namespace robosim
