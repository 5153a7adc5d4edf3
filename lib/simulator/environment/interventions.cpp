#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "base/text_table.h"
#include "environment/environment_impl.h"

namespace robosim {
namespace {

/// Maximum number of interventions of an author between two steps: bounds the time that a step waits for them.
constexpr std::size_t kInterventionsMax = 1000;
/// Tolerance of times in World::timeline [steps]: absorbs the rounding error of the time.
constexpr double kDueTolerance = 1e-6;

std::string inQuotes(const std::string& name) { return "'" + name + "'"; }

}  // namespace

/// Applies one change. The functions return what is wrong, or an empty text.
struct Environment::Impl::ApplyChange {
  Impl& of;
  bool is_checked;  ///< false: the change is known to be valid

  std::string operator()(const PlaceBody& place) const {
    if (const auto robot = robotNamed(place.name)) {
      const double heading_rad = place.heading_rad.value_or(of.state.world_from_robot[*robot].phi);
      if (is_checked) {
        const Solid disc = of.bodies.discOf(*robot, {place.x_m, place.y_m});
        if (!of.model->world.bounds.covers(boundsOf(disc.outline))) return notOnSurface(place.name);
        if (const auto fault = overlapFault(place.name, disc, of.scene.movingBody(*robot)); !fault.empty())
          return fault;
      }
      of.moveRobot(*robot, {place.x_m, place.y_m, heading_rad});
      return {};
    }
    const auto object = objectNamed(place.name);
    if (!object) return unknown(place.name, "a robot or an object");
    if (objects()[*object].door) return inQuotes(place.name) + " is a door, which stays in its frame; open or close it";
    return change(*object, place);
  }

  std::string operator()(const AddObject& add) const {
    if (objectNamed(add.object.name) || robotNamed(add.object.name)) {
      return "there is a robot or an object named " + inQuotes(add.object.name) + " already; use another name";
    }
    if (objects().size() >= kScatteredMax) {
      return "the world has " + withCommas(objects().size()) +
             " objects, the most that interventions add to; remove some";
    }
    if (const auto fault = placeFault(add.object, kNoBody); !fault.empty()) return fault;
    of.setObjects(withChange(objects(), add), add.object.name);
    return {};
  }

  std::string operator()(const AddRobot& add) const {
    if (is_checked) {
      if (auto fault = nameFault(add); !fault.empty()) return fault;
    }
    std::shared_ptr<const Model> larger;
    try {
      larger = of.modelWith(of.model->additions.with(add));
    } catch (const ConfigError& error) {
      return error.errors().front();
    }
    const FleetRobot& robot = larger->fleet.robots.back();
    if (is_checked) {
      const Solid disc{Circle{{add.world_from_robot.x, add.world_from_robot.y}, robot.info.radius_m},
                       robot.body().heights()};
      if (!of.model->world.bounds.covers(boundsOf(disc.outline))) return notOnSurface(add.name);
      if (auto fault = overlapFault(add.name, disc, kNoBody); !fault.empty()) return fault;
      if (auto fault = of.robot_check ? of.robot_check(robot) : std::string(); !fault.empty()) return fault;
    }
    of.addRobot(std::move(larger));
    return {};
  }

  std::string operator()(const RemoveBody& remove) const {
    if (const auto robot = robotNamed(remove.name)) {
      if (of.state.isAbsent(*robot)) return absent(remove.name);
      of.remove({&*robot, 1});
      return {};
    }
    if (!objectNamed(remove.name)) return unknown(remove.name, "a robot or an object");
    of.setObjects(withChange(objects(), remove), remove.name);
    return {};
  }

  std::string operator()(const ChangeObject& properties) const {
    const auto object = objectNamed(properties.name);
    if (!object && robotNamed(properties.name)) {
      return inQuotes(properties.name) + " is a robot, whose body stays as its type describes it; name an object";
    }
    if (!object) return unknown(properties.name, "an object");
    return change(*object, properties);
  }

  std::string operator()(const ChangeActivity& change) const {
    const auto robot = robotNamed(change.robot);
    if (!robot && objectNamed(change.robot)) return inQuotes(change.robot) + " is an object; name a robot";
    if (!robot) return unknown(change.robot, "a robot");
    if (of.state.isAbsent(*robot)) return absent(change.robot);
    of.state.activity[*robot] = of.state.commands[*robot].activity = change.activity;
    if (!of.state.haveAllHalted()) of.state.all_halted_step.reset();
    ++of.pose_changes;
    return {};
  }

  std::string operator()(const ChangeRadio& change) const {
    of.state.communication = change.communication;
    of.message_router.setCommunication(change.communication);
    return {};
  }

  std::string operator()(const OpenDoor& open) const {
    const auto object = objectNamed(open.name);
    if (!object || !objects()[*object].door) {
      if (object || robotNamed(open.name)) return inQuotes(open.name) + " is no door; name one";
      return unknown(open.name, "a door");
    }
    of.setObjects(withChange(objects(), open), {});
    return {};
  }

  std::string operator()(const EndRun& end) const {
    if (of.state.ended) return "the run has ended already, with the outcome " + inQuotes(of.state.ended->outcome);
    of.state.ended = RunEnd{end.outcome, end.text, of.state.time.step};
    return {};
  }

 private:
  const std::vector<WorldObject>& objects() const { return of.objects(); }

  std::optional<std::size_t> robotNamed(const std::string& name) const { return of.message_router.names().find(name); }
  std::optional<std::size_t> objectNamed(const std::string& name) const {
    const auto found = std::find_if(objects().begin(), objects().end(),
                                    [&](const WorldObject& object) { return object.name == name; });
    if (found == objects().end()) return std::nullopt;
    return static_cast<std::size_t>(found - objects().begin());
  }

  /// What is wrong with the names and the number of robots.
  std::string nameFault(const AddRobot& add) const {
    if (objectNamed(add.name) || robotNamed(add.name)) {
      return "there is a robot or an object named " + inQuotes(add.name) + " already; use another name";
    }
    if (!add.neighbour.empty() && !robotNamed(add.neighbour)) return unknown(add.neighbour, "a robot");
    if (of.state.additions.size() >= kAddedRobotsMax) {
      return withCommas(kAddedRobotsMax) + " robots have been added to the run, which is the most; give the world more";
    }
    return {};
  }

  /// Changes an object.
  std::string change(std::size_t object, const Change& how) const {
    const Body before = objects()[object].body;
    std::vector<WorldObject> all = withChange(objects(), how);
    const Body& after = all[object].body;
    if (is_checked && after.heights().z_max_m > 0 && all[object].conveyor) {
      return inQuotes(all[object].name) + " is a belt, which is let into the floor: its top would be " +
             fixed(after.heights().z_max_m, 3) + " m above it; make it lower";
    }
    const bool moves = after.world_from_body != before.world_from_body || after.heights() != before.heights();
    if (moves) {
      if (auto fault = placeFault(all[object], of.bodies.bodyOf(object)); !fault.empty()) return fault;
    }
    of.setObjects(std::move(all), moves ? objects()[object].name : std::string());
    return {};
  }

  /// What is wrong with the place of an object. @param own its body in the scene; kNoBody for a new one
  std::string placeFault(const WorldObject& object, BodyId own) const {
    if (!is_checked) return {};
    const auto& pose = object.body.world_from_body;
    const Bounds2D& surface = of.model->world.bounds;
    const bool is_on_surface = object.movable || object.walker ? surface.covers(boundsOf(object.body.solid().outline))
                                                               : surface.contains({pose.x, pose.y});
    if (!is_on_surface) return notOnSurface(object.name);
    if (object.body.isFloor() && !object.conveyor) return {};  // areas of the floor are painted over one another
    // Doors may be in walls.
    const auto among = object.door ? PlacedBodies::Among::moving : PlacedBodies::Among::all;
    return overlapFault(object.name, object.body.solid(), own, among);
  }

  std::string overlapFault(const std::string& name, const Solid& solid, BodyId own,
                           PlacedBodies::Among among = PlacedBodies::Among::all) const {
    const BodyId other = of.bodies.overlapped(solid, own, among);
    if (other == kNoBody) return {};
    return inQuotes(name) + " would overlap " + described(other) + "; choose another place";
  }

  std::string described(BodyId body) const {
    if (const auto object = of.bodies.objectOf(body)) return inQuotes(objects()[*object].name);
    if (!of.bodies.isRobot(body)) return "a wall of a map";
    return inQuotes(of.message_router.names()[of.scene.movingIndex(body)]);
  }

  std::string notOnSurface(const std::string& name) const {
    const Bounds2D& surface = of.model->world.bounds;
    return inQuotes(name) + " would not be on the surface, which is x " + fixed(surface.x_min, 3) + " to " +
           fixed(surface.x_max, 3) + " m and y " + fixed(surface.y_min, 3) + " to " + fixed(surface.y_max, 3) +
           " m; choose another place";
  }
  static std::string absent(const std::string& name) {
    return "robot " + inQuotes(name) + " is not in the world at present; place it first";
  }
  std::string unknown(const std::string& name, const std::string& what) const {
    std::vector<std::string> names = of.message_router.names().list();
    for (const auto& object : objects()) names.push_back(object.name);
    std::erase(names, name);  // of another kind
    return inQuotes(name) + " is not the name of " + what + (name.empty() ? "" : didYouMean(name, names));
  }
};

std::string Environment::Impl::apply(const Intervention& intervention, bool is_checked) {
  const std::uint64_t next_step = state.time.step + 1;
  if (is_checked) {
    if (state.ended && !std::holds_alternative<EndRun>(intervention.change)) {
      return "the run has ended, with the outcome " + inQuotes(state.ended->outcome) + ", and is not changed any more";
    }
    if (std::string fault = faultOf(intervention.change); !fault.empty()) return fault;
    const auto count = std::count_if(state.interventions.begin(), state.interventions.end(), [&](const auto& applied) {
      return applied.step == next_step && applied.intervention.author == intervention.author;
    });
    if (static_cast<std::size_t>(count) >= kInterventionsMax && intervention.author != kWorldFileAuthor) {
      return "there are " + withCommas(kInterventionsMax) + " interventions of " + intervention.author +
             " before this step, which is the most; wait for the next step";
    }
  }
  if (std::string fault = std::visit(ApplyChange{*this, is_checked}, intervention.change); !fault.empty()) return fault;
  state.interventions.push_back({next_step, intervention});
  ++state.interventions_applied;
  if (state.digest) state.digest->add(next_step, intervention.change);
  return {};
}

void Environment::Impl::applyTimeline() {
  const auto& timeline = model->world.timeline;
  const auto due_step = [&](const TimedChange& timed) {
    return static_cast<std::uint64_t>(std::ceil(std::max(0.0, timed.time_s / model->period_s - kDueTolerance)));
  };
  auto next = std::partition_point(timeline.begin(), timeline.end(),
                                   [&](const TimedChange& timed) { return due_step(timed) < state.time.step; });
  for (; next != timeline.end() && due_step(*next) == state.time.step; ++next) {
    const TimedChange& timed = *next;
    const std::string fault = apply({kWorldFileAuthor, timed.change}, true);
    if (fault.empty()) continue;
    logWarning("", "the change in line " + std::to_string(timed.line.number) + " of the world file, at " +
                       fixed(timed.time_s, 3) + " s, has no effect: " + fault);
  }
}

std::string Environment::apply(const Intervention& intervention) { return impl_->apply(intervention, true); }

void Environment::applyAgain(const Intervention& intervention) { impl_->apply(intervention, false); }

}  // namespace robosim
