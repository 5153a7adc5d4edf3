#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "control/controller_type.h"
#include "environment/environment.h"
#include "environment/local_hardware.h"
#include "robots/fleet.h"
#include "robots/world_source.h"
#include "run/run_observers.h"
#include "sensors/image_source.h"

namespace robosim {

class SelectedImages;  // run/selected_images.h

struct RunOptions {
  EnvironmentOptions environment;
  /// For all robots, as TypeChoice::text(); empty: as given in the world, else kDefaultController.
  std::string controller;
  std::vector<std::string> observers = {};  ///< as TypeChoice::text()
  bool observers_log = true;                ///< whether ObserverSetup::log prints
  /// Whether observers may change the run: not when their recorded changes are repeated.
  bool observers_supervise = true;
  /// Mean time until a robot breaks down for good, exponentially distributed: it halts, and its controller is called no
  /// more [simulated s]; 0: none does.
  double breakdown_mean_s = 0;
  /// For robots that interventions add and that name none, in place of `controller`; empty: `controller`.
  std::string controller_of_added = {};
  /// Whether another process drives a robot that an intervention adds; null: none does.
  std::function<bool(const FleetRobot&)> is_added_elsewhere = {};
  bool checks_added_elsewhere = false;  ///< whether controllers of those robots must be of this program, as on ranks
  /// Why a robot cannot be added to the run, and how to change that; empty: it can. Null: all can, as far as a LocalRun
  /// is concerned.
  RobotCheck check_added = {};
  bool takes_pictures = true;  ///< otherwise cameras take none, which saves most of the time of a run with cameras
  /// Only the cameras of robots of LocalRun::selectPictures() take pictures, and those of robots whose controller in
  /// this process requires them.
  bool pictures_on_request = false;
};

/// Controller of robots for which neither the world nor the command line gives one: the 2005 application.
constexpr const char* kDefaultController = "gold_finder";

/// Checks name and parameters of a controller, given as TypeChoice::text(). @throws ConfigError
void checkController(const std::string& controller);

/// Whether a controller must be given the map of the world (ControllerType::knows_world). @throws ConfigError
bool knowsWorld(const std::string& controller);

/// Makes the controller of a robot.
/// @throws ConfigError for an unknown controller, an invalid parameter, or a controller that knows the world and is not
/// given map and start pose; ControllerError naming both for an exception of its constructor
std::unique_ptr<Controller> makeController(const std::string& choice, const ControllerSetup& setup,
                                           const std::string& robot);

/// A robot's controller, as TypeChoice::text().
/// @param in_world that given in the world; empty for none
/// @param instead replaces it if not empty
std::string controllerOf(const std::string& in_world, const std::string& instead);

/// Whether a robot, of this index in the world's order, needs no controller of RoboSim.
using DrivenElsewhere = std::function<bool(const FleetRobot&, std::size_t index)>;

/// Whether a controller, given as TypeChoice::text(), requires a camera or a blob finder. @throws ConfigError
bool needsPictures(const std::string& controller);
/// Whether something in the run reads pictures: a controller of a world, or the one `instead` of them, that requires a
/// camera or a blob finder, or an observer that reads them.
/// @throws ConfigError for an unknown controller or observer
bool needPictures(const Fleet& fleet, const std::string& instead, const std::vector<std::string>& observers = {});

/// Kinds of sensors that a controller requires and a robot with these sensors lacks.
std::vector<SensorKind> missingSensors(const ControllerType& type, const std::vector<SensorInfo>& sensors);

/// Adds an error for each robot that lacks a sensor required by its controller. `world_file` is the file name in
/// errors.
void checkControllers(const LoadedWorld& world, const std::string& world_file, const std::string& instead,
                      ErrorList& errors, const DrivenElsewhere& is_elsewhere = {});

/// Reads a world to be run: loadWorld() plus checkControllers(); requires at least one robot.
/// @throws ConfigError with all errors found.
LoadedWorld loadWorldToRun(const std::string& file, const std::string& instead, std::uint64_t seed = kDefaultSeed);
LoadedWorld loadWorldToRun(const WorldSource& source, const std::string& instead,
                           const DrivenElsewhere& is_elsewhere = {});

/// Makes the ImageSource of a run in which robots have cameras.
using ImageSourceMaker = std::unique_ptr<ImageSource> (*)(const World&, const Fleet&);
/// Sets the maker of this process, before its first run: that of the library robosim::rendering,
/// makeOffscreenRenderer(). Without one, runs with cameras are refused.
void setImageSourceMaker(ImageSourceMaker maker);

/// Times when the gold was found, won and all robots had stopped [simulated s], and by which robot.
struct GoldOutcome {
  std::optional<std::string> found_by;
  std::optional<double> found_s;
  std::optional<std::string> won_by;  ///< robot that reached the gold and reported it (CheckWin)
  std::optional<double> won_s;
  std::optional<double> all_halted_s;
};

/// An environment together with the controllers of its robots in this process.
class LocalRun {
 public:
  /// @param elsewhere by robot: whether it is driven by another process; empty for none
  /// @throws ConfigError for an unknown controller or observer, and for cameras without an
  /// ImageSourceMaker or on a machine without OpenGL.
  /// @throws ControllerError, ObserverError for an exception of one's constructor
  LocalRun(LoadedWorld world, const RunOptions& options, const std::vector<std::uint8_t>& elsewhere = {});

  /// Replaces the controllers of this process by others, such as ones that use them.
  /// @param wrap called with the robot's hardware, which outlives the controller
  void wrapControllers(
      const std::function<std::unique_ptr<Controller>(LocalHardware&, std::unique_ptr<Controller>)>& wrap);

  /// What fork() does with robots that LocalRun does not run the controllers of.
  enum class Elsewhere { refuse, keep };
  /// A run that continues from the present state, independently of this one.
  /// @throws ConfigError naming the robot and its controller when the controller has no Controller::clone(), or when
  /// another process drives the robot and `elsewhere` is refuse; naming an observer that has no Observer::clone()
  std::unique_ptr<LocalRun> fork(Elsewhere elsewhere = Elsewhere::refuse) const;

  /// Runs every controller, then takes one time step.
  /// @param record reads the step, before observers change the run for the next one
  /// @throws ControllerError for an exception of a controller
  /// @throws ObserverError for an exception of an observer, after the step
  void step(const std::function<void()>& record = {});
  /// @name Phases of step(), for callers that step the environment themselves
  ///@{
  void decide();
  /// Makes controllers of robots that have been added, and forgets those of robots that the present state does not
  /// have. Called by the other functions; to be called before others when the environment has been changed or restored.
  void followAdditions();
  /// Calls the observers, after the step. @param record as above
  void observe(const std::function<void()>& record = {});
  ///@}

  /// @name With RunOptions::pictures_on_request
  /// Flags by robot; initially none. Robots whose controllers in this process require pictures are always among them.
  /// Without cameras, and without this option, they have no effect.
  ///@{
  /// Robots whose cameras take pictures in the next step.
  void selectPictures(std::vector<std::uint8_t> robots);
  /// Takes the pictures of the present step of those robots for which it has not been done.
  void takePictures(const std::vector<std::uint8_t>& requested);
  ///@}

  Environment& environment() { return environment_; }
  const Environment& environment() const { return environment_; }
  GoldOutcome gold() const;  ///< that of the State
  const RunObservers& observers() const { return observers_; }
  /// Whether the run has reached an end of its own: all robots have halted, or an observer or an intervention ends it.
  bool isOver() const {
    const State& state = environment_.state();
    return state.ended || state.all_halted_step || observers_.end();
  }
  /// Whether another seed would give another run: some sensor is noisy, messages are lost, or a controller has drawn a
  /// random number. Assumed for robots driven by another process.
  bool dependsOnSeed() const;
  /// Whether a controller in this process has drawn a random number.
  bool hasDrawnRandomNumbers() const;
  /// For dependsOnSeed(): whether a controller in another process has, when these are known to be controllers of
  /// RoboSim.
  void setDrawnElsewhere(bool has_drawn) { has_drawn_elsewhere_ = has_drawn; }

 private:
  /// What robots with equal controllers have in common.
  struct ControllerKind {
    std::string name;     ///< as TypeChoice::text()
    bool reads_pictures;  ///< whether it requires a camera or a blob finder
  };
  /// Small, because a run may have very many robots.
  struct LocalRobot {
    LocalHardware hardware;
    Robot robot;
    const ControllerKind& kind;
    std::unique_ptr<Controller> controller;
    LocalRobot(Environment& environment, std::size_t i, const ControllerKind& the_kind, std::unique_ptr<Controller> c)
        : hardware(environment, i), robot(hardware), kind(the_kind), controller(std::move(c)) {}
    std::size_t index() const { return hardware.robot(); }
  };
  const ControllerKind& kindOf(const std::string& controller);
  /// By robot: flags, and whether its controller in this process requires pictures.
  std::vector<std::uint8_t> withPictureReaders(std::vector<std::uint8_t> robots) const;
  /// Makes the controller of a robot.
  void addRobot(std::size_t robot, const std::string& controller);
  void allowAdditions();
  /// Whatever an option refuses is refused before the run, not in its course, which would be another run. @throws
  /// ConfigError for a robot that the world file adds and that cannot be added
  void checkTimeline() const;
  std::string faultOfAdded(const FleetRobot& robot) const;
  std::string controllerOfAdded(const FleetRobot& robot) const;

  struct ForkOf {
    const LocalRun& run;
    Elsewhere elsewhere;
  };
  explicit LocalRun(ForkOf original);

  RunOptions options_;
  /// Null without cameras; OpenGL is then not initialised. Shared with forks, because pictures depend on poses only.
  std::shared_ptr<ImageSource> images_;
  SelectedImages* selected_images_ = nullptr;  ///< the same, with RunOptions::pictures_on_request; else null
  /// By robot: whether the pictures of a step, with RunOptions::pictures_on_request, have been taken.
  std::vector<std::uint8_t> taken_;
  std::optional<std::uint64_t> taken_step_;
  bool had_camera_;  ///< a robot, at the start, that needsImageSource()
  Environment environment_;
  ParallelExecutor workers_;
  std::map<std::string, ControllerKind> controller_kinds_;  ///< by name; LocalRobots refer to them
  std::deque<LocalRobot> local_robots_;  ///< in the world's order; at fixed places, because each refers to its parts
  std::vector<double> breakdown_s_;      ///< simulated times, by robot; empty if none breaks down
  RobotAdditions additions_;             ///< those that have been followed
  std::shared_ptr<const KnownWorld> known_world_;  ///< null until a controller needs it
  std::optional<bool> has_drawn_elsewhere_;
  RunObservers observers_;
};

}  // namespace robosim
