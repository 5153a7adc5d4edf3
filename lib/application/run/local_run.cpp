#include "run/local_run.h"

#include <algorithm>
#include <iterator>
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/portable_math.h"
#include "base/random.h"
#include "control/controller_error.h"
#include "maze/controllers.h"
#include "run/known_world.h"
#include "run/selected_images.h"

namespace robosim {
namespace {

void checkToRun(const LoadedWorld& world, const std::string& file, const std::string& instead,
                const DrivenElsewhere& is_elsewhere = {}) {
  ErrorList errors;
  checkControllers(world, file, instead, errors, is_elsewhere);
  errors.throwIfAny();
  if (world.fleet.robots.empty()) throw ConfigError(file + ": has no robots; add at least one");
}

/// Reading a file takes several times the memory of the resulting world. That memory is free by now but fragmented, and
/// would stay with the process without malloc_trim().
void releaseFreeMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

ImageSourceMaker& imageSourceMaker() {
  static ImageSourceMaker maker = nullptr;
  return maker;
}

std::unique_ptr<ImageSource> imagesFor(const World& world, const Fleet& fleet, const RunOptions& options) {
  if (!options.takes_pictures || !needsImageSource(fleet)) return nullptr;
  if (!imageSourceMaker())
    throw ConfigError(
        "robots have cameras, but this program cannot render pictures; it must call "
        "setImageSourceMaker(makeOffscreenRenderer), of the library robosim::rendering");
  auto images = imageSourceMaker()(world, fleet);
  if (!options.pictures_on_request) return images;
  return std::make_unique<SelectedImages>(std::move(images));
}

/// When a robot breaks down [simulated s].
/// @pre robots do
double drawBreakdownTime(std::size_t robot, const RunOptions& options) {
  Rng rng(options.environment.seed, RandomPurpose::breakdown, static_cast<std::uint32_t>(robot));
  return -options.breakdown_mean_s * portable::log(1 - rng.uniform());
}

const ControllerType* typeOrNull(const std::string& controller) {
  try {
    return &controllers().typeOf(controller);
  } catch (const ConfigError&) {
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<Controller> makeController(const std::string& choice, const ControllerSetup& setup,
                                           const std::string& robot) {
  if (knowsWorld(choice) && (!setup.known_world || !setup.world_from_start)) {
    throw ConfigError("controller '" + choice + "' of robot '" + robot +
                      "' requires the map of the world and the robot's start in it; give the world file by --map, or " +
                      "use another controller");
  }
  std::unique_ptr<Controller> controller;
  try {
    controller = controllers().make(choice, setup);
  } catch (const ConfigError&) {
    throw;
  } catch (...) {
    throwControllerError(choice, robot);
  }
  if (!controller)
    throw ControllerError("controller '" + choice + "' of robot '" + robot + "': its type has made none");
  return controller;
}

bool needsPictures(const std::string& controller) {
  const auto& needs = controllers().typeOf(controller).needs;
  return std::any_of(needs.begin(), needs.end(),
                     [](SensorKind kind) { return kind == SensorKind::camera || kind == SensorKind::blob_finder; });
}

bool needPictures(const Fleet& fleet, const std::string& instead, const std::vector<std::string>& observers) {
  return readPictures(observers) || std::any_of(fleet.robots.begin(), fleet.robots.end(), [&](const FleetRobot& robot) {
           return needsPictures(controllerOf(*robot.controller, instead));
         });
}

void setImageSourceMaker(ImageSourceMaker maker) { imageSourceMaker() = maker; }

bool knowsWorld(const std::string& controller) { return controllers().typeOf(controller).knows_world; }

void checkController(const std::string& controller) { controllers().parametersOf(controller); }

std::string controllerOf(const std::string& in_world, const std::string& instead) {
  if (!instead.empty()) return instead;
  return in_world.empty() ? kDefaultController : in_world;
}

std::vector<SensorKind> missingSensors(const ControllerType& type, const std::vector<SensorInfo>& sensors) {
  std::vector<SensorKind> missing;
  std::copy_if(type.needs.begin(), type.needs.end(), std::back_inserter(missing), [&](SensorKind kind) {
    return std::none_of(sensors.begin(), sensors.end(), [&](const SensorInfo& sensor) { return sensor.kind == kind; });
  });
  return missing;
}

void checkControllers(const LoadedWorld& world, const std::string& world_file, const std::string& instead,
                      ErrorList& errors, const DrivenElsewhere& is_elsewhere) {
  const std::size_t count = std::min(world.world.robots.size(), world.fleet.robots.size());
  for (std::size_t i = 0; i < count; ++i) {
    const FleetRobot& robot = world.fleet.robots[i];
    if (is_elsewhere && is_elsewhere(robot, i)) continue;
    const ControllerType* type = typeOrNull(controllerOf(*robot.controller, instead));
    if (!type) continue;  // reported by buildFleet()
    for (const SensorKind kind : missingSensors(*type, *robot.info.sensors)) {
      const SourceLine& line = world.world.robots[i].line;
      errors.add(world.world.fileOf(line, world_file), line.number,
                 "robot '" + robot.info.name + "': its controller " + type->name + " requires a sensor of kind " +
                     nameOf(kind) + "; add one, or use another controller");
    }
  }
}

LoadedWorld loadWorldToRun(const std::string& file, const std::string& instead, std::uint64_t seed) {
  LoadedWorld world = loadWorld(file, checkController, seed);
  checkToRun(world, file, instead);
  // The fleet has copied what it needs. (= {} would keep the memory.)
  world.world.robots = std::vector<RobotPlacement>();
  world.world.objects.shrink_to_fit();
  releaseFreeMemory();
  return world;
}

LoadedWorld loadWorldToRun(const WorldSource& source, const std::string& instead, const DrivenElsewhere& is_elsewhere) {
  LoadedWorld world = loadWorld(source, checkController);
  checkToRun(world, source.file, instead, is_elsewhere);
  releaseFreeMemory();
  return world;
}

LocalRun::LocalRun(LoadedWorld world, const RunOptions& options, const std::vector<std::uint8_t>& elsewhere)
    : options_(options),
      images_(imagesFor(world.world, world.fleet, options)),
      selected_images_(options.pictures_on_request ? static_cast<SelectedImages*>(images_.get()) : nullptr),
      had_camera_(needsImageSource(world.fleet)),
      environment_(std::move(world.world), std::move(world.fleet), options.environment, images_.get()),
      workers_(options.environment.threads),
      observers_(options.observers, options.environment.seed, options.observers_log, options.observers_supervise) {
  for (std::size_t i = 0; i < environment_.robotCount(); ++i) {
    if (elsewhere.empty() || !elsewhere[i]) {
      addRobot(i, controllerOf(*environment_.fleet().robots[i].controller, options.controller));
    }
  }
  allowAdditions();
  checkTimeline();
  takePictures(std::vector<std::uint8_t>(environment_.robotCount(), readPictures(options.observers) ? 1 : 0));
  selectPictures({});
  observe();
}

LocalRun::LocalRun(ForkOf original)
    : options_(original.run.options_),
      images_(original.run.images_),
      selected_images_(original.run.selected_images_),
      had_camera_(original.run.had_camera_),
      environment_(original.run.environment_.model(), original.run.environment_.state(), options_.environment.threads,
                   images_.get()),
      workers_(options_.environment.threads),
      breakdown_s_(original.run.breakdown_s_),
      additions_(original.run.additions_),
      known_world_(original.run.known_world_),
      observers_(RunObservers::Fork{original.run.observers_}) {
  const auto& robots = environment_.fleet().robots;
  auto local = original.run.local_robots_.begin();  // in the world's order
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::string& name = robots[i].info.name;
    if (local == original.run.local_robots_.end() || local->robot.name() != name) {
      if (original.elsewhere == Elsewhere::keep) continue;
      throw ConfigError("robot '" + name + "': another process drives it, so that its run cannot be forked; let this " +
                        "process run its controller");
    }
    const ControllerKind& kind = kindOf(local->kind.name);
    auto controller = cloneController(*local->controller, kind.name, name);
    local_robots_.emplace_back(environment_, i, kind, std::move(controller));
    ++local;
  }
  allowAdditions();
}

void LocalRun::addRobot(std::size_t i, const std::string& name) {
  const FleetRobot& robot = environment_.fleet().robots[i];
  ControllerSetup setup{options_.environment.seed, static_cast<std::uint32_t>(i), robot.world_from_start};
  if (knowsWorld(name)) {
    if (!known_world_) known_world_ = makeKnownWorld(environment_.world(), environment_.fleet());
    setup.known_world = known_world_;
  }
  auto controller = makeController(name, setup, robot.info.name);
  local_robots_.emplace_back(environment_, i, kindOf(name), std::move(controller));
  if (options_.breakdown_mean_s <= 0) return;
  breakdown_s_.resize(environment_.robotCount(), std::numeric_limits<double>::infinity());
  breakdown_s_[i] = drawBreakdownTime(i, options_);
}

const LocalRun::ControllerKind& LocalRun::kindOf(const std::string& controller) {
  const auto known = controller_kinds_.find(controller);
  if (known != controller_kinds_.end()) return known->second;
  return controller_kinds_.emplace(controller, ControllerKind{controller, needsPictures(controller)}).first->second;
}

void LocalRun::allowAdditions() {
  environment_.setRobotCheck([this](const FleetRobot& robot) { return faultOfAdded(robot); });
  environment_.setImagesOf([this](const Model& model) {
    images_ = imagesFor(model.world, model.fleet, options_);
    if (options_.pictures_on_request) {
      auto* const selected = static_cast<SelectedImages*>(images_.get());
      if (selected && selected_images_) selected->selected = selected_images_->selected;
      selected_images_ = selected;
    }
    return images_.get();
  });
}

void LocalRun::checkTimeline() const {
  for (const TimedChange& timed : environment_.world().timeline) {
    const auto* robot = std::get_if<AddRobot>(&timed.change);
    if (!robot) continue;
    const auto with_robot = withAdditions(*environment_.model(), environment_.state().additions.with(*robot));
    if (const std::string fault = faultOfAdded(with_robot->fleet.robots.back()); !fault.empty()) {
      throw ConfigError("the world adds the robot '" + robot->name + "' during the run: " + fault);
    }
  }
}

std::string LocalRun::faultOfAdded(const FleetRobot& robot) const {
  if (options_.check_added) {
    if (std::string fault = options_.check_added(robot); !fault.empty()) return fault;
  }
  // Whatever is recorded or shown: that does not change a run.
  if (needsImageSource(robot.info) && !had_camera_) {
    return "no robot had a camera at the start of the run, so that none with a camera can be added; use another robot "
           "type, or give the world a robot with a camera";
  }
  if (!options_.checks_added_elsewhere && options_.is_added_elsewhere && options_.is_added_elsewhere(robot)) return {};
  const std::string name = controllerOfAdded(robot);
  try {
    checkController(name);
  } catch (const ConfigError& error) {
    return error.errors().front();
  }
  const ControllerType& type = controllers().typeOf(name);
  for (const SensorKind kind : missingSensors(type, *robot.info.sensors)) {
    return "its controller " + type.name + " requires a sensor of kind " + nameOf(kind) +
           "; use another controller or robot type";
  }
  return {};
}

std::string LocalRun::controllerOfAdded(const FleetRobot& robot) const {
  if (!robot.controller->empty()) return *robot.controller;
  return controllerOf({}, options_.controller_of_added.empty() ? options_.controller : options_.controller_of_added);
}

void LocalRun::followAdditions() {
  const RobotAdditions& now = environment_.state().additions;
  if (now == additions_) return;
  const auto before = additions_.list(), after = now.list();
  const std::size_t count = environment_.robotCount(), at_start = count - after.size();
  const auto same = static_cast<std::size_t>(
      std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first - before.begin());
  while (!local_robots_.empty() && local_robots_.back().index() >= at_start + same) local_robots_.pop_back();
  for (std::size_t i = at_start + same; i < count; ++i) {
    const FleetRobot& robot = environment_.fleet().robots[i];
    if (options_.is_added_elsewhere && options_.is_added_elsewhere(robot)) continue;
    addRobot(i, controllerOfAdded(robot));
  }
  additions_ = now;
  if (selected_images_) selectPictures(std::move(selected_images_->selected));
  if (!taken_.empty()) taken_.resize(count);
}

void LocalRun::wrapControllers(
    const std::function<std::unique_ptr<Controller>(LocalHardware&, std::unique_ptr<Controller>)>& wrap) {
  for (LocalRobot& local : local_robots_) local.controller = wrap(local.hardware, std::move(local.controller));
}

std::unique_ptr<LocalRun> LocalRun::fork(Elsewhere elsewhere) const {
  return std::unique_ptr<LocalRun>(new LocalRun(ForkOf{*this, elsewhere}));
}

bool LocalRun::dependsOnSeed() const {
  const auto& robots = environment_.fleet().robots;
  const auto is_noisy = [](const FleetRobot& robot) {
    return std::any_of(robot.model->sensors.begin(), robot.model->sensors.end(),
                       [](const auto& sensor) { return sensor->isNoisy(); });
  };
  const bool all_are_here = local_robots_.size() == robots.size();
  const auto& timeline = environment_.world().timeline;
  const bool has_random_radio = environment_.world().communication.isRandom() ||
                                environment_.communication().isRandom() ||
                                std::any_of(timeline.begin(), timeline.end(), [](const TimedChange& timed) {
                                  const auto* radio = std::get_if<ChangeRadio>(&timed.change);
                                  return radio && radio->communication.isRandom();
                                });
  return has_drawn_elsewhere_.value_or(!all_are_here) || options_.breakdown_mean_s > 0 || has_random_radio ||
         std::any_of(robots.begin(), robots.end(), is_noisy) || hasDrawnRandomNumbers();
}

bool LocalRun::hasDrawnRandomNumbers() const {
  return std::any_of(local_robots_.begin(), local_robots_.end(),
                     [](const auto& robot) { return robot.controller->hasDrawnRandomNumbers(); });
}

void LocalRun::selectPictures(std::vector<std::uint8_t> robots) {
  if (selected_images_) selected_images_->selected = withPictureReaders(std::move(robots));
}

void LocalRun::takePictures(const std::vector<std::uint8_t>& requested) {
  if (!selected_images_) return;
  const std::vector<std::uint8_t> robots = withPictureReaders(requested);
  std::vector<std::uint8_t>& selected = selected_images_->selected;
  const std::size_t count = environment_.robotCount();
  if (taken_step_ != environment_.time().step) {
    // Step 0 is taken before anything is selected.
    taken_ = environment_.time().step > 0 ? selected : std::vector<std::uint8_t>();
    taken_.resize(count);
    taken_step_ = environment_.time().step;
  }
  std::vector<std::uint32_t> missing;
  for (std::size_t i = 0; i < std::min(count, robots.size()); ++i) {
    if (robots[i] && !taken_[i]) missing.push_back(static_cast<std::uint32_t>(i));
  }
  if (missing.empty()) return;
  std::vector<std::uint8_t> only(count);
  for (const std::uint32_t robot : missing) only[robot] = taken_[robot] = 1;
  selected.swap(only);
  measureWithCameras(environment_, missing);
  selected.swap(only);
}

std::vector<std::uint8_t> LocalRun::withPictureReaders(std::vector<std::uint8_t> robots) const {
  robots.resize(environment_.robotCount());
  for (const auto& local : local_robots_) {
    if (local.index() < robots.size() && local.kind.reads_pictures) robots[local.index()] = 1;
  }
  return robots;
}

void LocalRun::step(const std::function<void()>& record) {
  decide();
  environment_.step();
  observe(record);
}

void LocalRun::decide() {
  followAdditions();
  constexpr std::size_t kChunk = 16;
  workers_.forEach(local_robots_.size(), kChunk, [&](std::size_t i) {
    LocalRobot& local = local_robots_[i];
    if (!breakdown_s_.empty() && environment_.time().seconds() >= breakdown_s_[local.index()]) {
      if (local.robot.activity() == Activity::active) local.robot.halt();
      return;
    }
    try {
      local.controller->step(local.robot);
    } catch (...) {
      throwControllerError(local.kind.name, local.robot.name());
    }
  });
}

void LocalRun::observe(const std::function<void()>& record) {
  followAdditions();
  observers_.observe(environment_);
  if (record) record();
  observers_.supervise(environment_);
}

GoldOutcome LocalRun::gold() const {
  const State& state = environment_.state();
  const auto name_of = [&](std::size_t robot) { return environment_.fleet().robots[robot].info.name; };
  const auto seconds_of = [&](std::uint64_t step) { return SimTime{step, state.time.period_s}.seconds(); };
  GoldOutcome gold;
  if (state.found) {
    gold.found_by = name_of(state.found->robot);
    gold.found_s = seconds_of(state.found->step);
  }
  if (state.won) {
    gold.won_by = name_of(state.won->robot);
    gold.won_s = seconds_of(state.won->step);
  }
  if (state.all_halted_step) gold.all_halted_s = seconds_of(*state.all_halted_step);
  return gold;
}

}  // namespace robosim
