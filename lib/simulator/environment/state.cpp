#include "environment/state.h"

#include <algorithm>

namespace robosim {
namespace {

/// Calls visit(array) for each array of the state.
template <typename StateType, typename Visit>
void forArrays(StateType& state, const Visit& visit) {
  visit(state.world_from_robot);
  visit(state.speed_mps);
  visit(state.turn_radps);
  visit(state.last_motion);
  visit(state.driven_m);
  visit(state.stalled);
  visit(state.activity);
  visit(state.laser_pan_rad);
  visit(state.commands);
  visit(state.outboxes);
  visit(state.win_requests);
  visit(state.readings);
}

std::size_t sizeOf(const Echoes& echoes) { return echoes.size(); }
std::size_t sizeOf(const Contacts& contacts) { return contacts.pressed.size(); }
std::size_t sizeOf(const Blobs& blobs) { return blobs.of_color.size(); }
template <typename Kind>
std::size_t sizeOf(const Kind&) {
  return 1;
}

std::size_t sizeOf(const Measurement& measurement) {
  return std::visit([](const auto& of_kind) { return sizeOf(of_kind); }, measurement);
}

/// Gives the robots of a fleet with other drives than differential ones their state.
void resizeDrives(State& state, const Fleet& fleet) {
  if (hasOtherDrives(fleet)) state.drives.resize(fleet.robots.size());
}

/// Whether the digest is of as many robots as the state.
bool digestFits(const State& state) {
  return !state.digest || state.digest->chunkCount() == RunDigest::chunkCountOf(state.readings.size());
}

bool haveSameShape(const State& a, const State& b) {
  std::vector<std::size_t> sizes_a, sizes_b;
  forArrays(a, [&](const auto& array) { sizes_a.push_back(array.size()); });
  forArrays(b, [&](const auto& array) { sizes_b.push_back(array.size()); });
  const auto same_measurement = [](const Measurement& x, const Measurement& y) {
    return x.index() == y.index() && sizeOf(x) == sizeOf(y);
  };
  const auto same_measurements = [&](const Readings& x, const Readings& y) {
    return std::equal(x.measurements.begin(), x.measurements.end(), y.measurements.begin(), y.measurements.end(),
                      same_measurement);
  };
  return a.time.period_s == b.time.period_s && sizes_a == sizes_b && a.drives.size() == b.drives.size() &&
         digestFits(a) && digestFits(b) &&
         std::equal(a.readings.begin(), a.readings.end(), b.readings.begin(), same_measurements);
}

}  // namespace

State initialState(const Model& model) { return initialState(model, {0, model.fleet.robots.size()}); }

State initialState(const Model& model, RobotRange with_readings) {
  const std::size_t n = model.fleet.robots.size();
  State state;
  state.time = {0, model.period_s};
  state.seed = model.seed;
  state.digest = RunDigest(n);
  state.additions = model.additions;
  forArrays(state, [n](auto& array) { array.resize(n); });
  resizeDrives(state, model.fleet);
  state.object_speeds.resize(movingObjects(model.world.objects).size());
  for (std::size_t i = 0; i < n; ++i) {
    const FleetRobot& robot = model.fleet.robots[i];
    state.world_from_robot[i] = robot.world_from_start;
    if (i < with_readings.begin || i >= with_readings.end) continue;
    state.readings[i].measurements = blankMeasurements(*robot.model);
  }
  return state;
}

std::vector<Measurement> blankMeasurements(const RobotModel& model) {
  std::vector<Measurement> measurements;
  measurements.reserve(model.sensors.size());
  for (const auto& sensor : model.sensors) measurements.push_back(sensor->blank());
  return measurements;
}

void addLastRobot(State& state, const Model& model) {
  const std::size_t i = model.fleet.robots.size() - 1;
  forArrays(state, [i](auto& array) { array.resize(i + 1); });
  resizeDrives(state, model.fleet);
  if (state.digest) state.digest->setRobots(i + 1);
  state.world_from_robot[i] = model.fleet.robots[i].world_from_start;
  Readings& readings = state.readings[i];
  readings.time = state.time;
  readings.measurements = blankMeasurements(*model.fleet.robots[i].model);
  if (state.won) readings.winner = model.fleet.robots[state.won->robot].info.name;
  state.additions = model.additions;
}

void resetRobot(State& state, std::size_t robot, Activity activity, const RobotModel& model) {
  state.speed_mps[robot] = state.turn_radps[robot] = 0;
  if (!state.drives.empty()) state.drives[robot] = {};
  state.last_motion[robot] = {};
  state.stalled[robot] = 0;
  state.activity[robot] = activity;
  state.laser_pan_rad[robot] = 0;
  state.commands[robot] = {.activity = activity};
  state.outboxes[robot].reset();
  state.win_requests[robot] = 0;
  Readings& readings = state.readings[robot];
  readings.inbox.clear();
  readings.stalled = readings.is_too_far = false;
  readings.laser_pan_rad = 0;
  readings.measurements = blankMeasurements(model);
}

bool State::haveAllHalted() const {
  return !activity.empty() && std::all_of(activity.begin(), activity.end(),
                                          [](Activity a) { return a == Activity::halted || a == Activity::found; });
}

void requireSameShape(const State& saved, const State& own) {
  if (haveSameShape(saved, own)) return;
  const auto described = [](const State& state) {
    return std::to_string(state.readings.size()) + " robots and steps of " + std::to_string(state.time.period_s) + " s";
  };
  throw std::invalid_argument("a state of " + described(saved) + " does not fit a world of " + described(own) +
                              ", or the sensors differ; use a state of the same world");
}

std::uint64_t messagesSent(const State& state) {
  std::uint64_t sent =
      state.messages_delivered + state.messages_dropped + state.messages_lost.total() + state.messages_in_flight.size();
  for (const auto& outbox : state.outboxes) {
    if (!outbox) continue;
    sent += outbox->surplus;
    for (const PendingMessage& message : outbox->messages) sent += message.receiversOf(state.outboxes.size());
  }
  return sent;
}

}  // namespace robosim
