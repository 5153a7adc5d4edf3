#include "environment/intervention_bytes.h"

#include <cmath>
#include <utility>
#include <vector>

#include "base/error_list.h"

namespace robosim {
namespace {

/// Longest text of a change.
constexpr std::size_t kChangeBytesMax = 1 << 20;
/// Of saved objects [m/s, rad/s].
constexpr double kObjectSpeedMax = 1e4;

Change takeChange(StateReader& in) {
  try {
    return parseChange(in.takeText(kChangeBytesMax), "a saved state");
  } catch (const ConfigError&) {
    throw InvalidContents("an intervention is invalid");
  }
}

template <typename Kind>
Kind takeChangeOf(StateReader& in) {
  const Change change = takeChange(in);
  requireContents(std::holds_alternative<Kind>(change), "an intervention is of another kind");
  return std::get<Kind>(change);
}

}  // namespace

void writeIntervention(const Intervention& intervention, StateWriter& out) {
  out.addText(intervention.author);
  out.addText(changeText(intervention.change));
}

Intervention readIntervention(StateReader& in) {
  std::string author = in.takeText(kChangeBytesMax);
  return {std::move(author), takeChange(in)};
}

AddRobot readAddition(StateReader& in) { return takeChangeOf<AddRobot>(in); }

void writeObjects(const ChangedObjects& changed, StateWriter& out) {
  out.addNumber(std::uint8_t{changed.areChanged()});
  if (!changed.areChanged()) return;
  const std::vector<WorldObject> none;
  const auto& objects = changed.orThose(none);
  out.addNumber(static_cast<std::uint32_t>(objects.size()));
  for (const WorldObject& object : objects) out.addText(changeText(AddObject{object}));
}

ChangedObjects readObjects(StateReader& in) {
  if (!in.takeFlag()) return {};
  std::vector<WorldObject> objects;
  for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
    objects.push_back(takeChangeOf<AddObject>(in).object);
  }
  return ChangedObjects(std::move(objects));
}

void writeSpeeds(const State& state, StateWriter& out) {
  out.addNumber(static_cast<std::uint32_t>(state.object_speeds.size()));
  for (const ObjectSpeed& speed : state.object_speeds) {
    for (const double number : {speed.vx_mps, speed.vy_mps, speed.turn_radps}) out.addNumber(number);
  }
}

void readSpeeds(StateReader& in, State& state) {
  const std::size_t movable =
      state.objects.areChanged() ? movingObjects(state.objects.orThose({})).size() : state.object_speeds.size();
  requireContents(in.takeNumber<std::uint32_t>() == movable, "the number of movable objects differs");
  state.object_speeds.resize(movable);
  for (ObjectSpeed& speed : state.object_speeds) {
    for (double* number : {&speed.vx_mps, &speed.vy_mps, &speed.turn_radps}) {
      *number = in.takeFinite();
      requireContents(std::abs(*number) <= kObjectSpeedMax, "an object is too fast");
    }
  }
}

void writeGrippers(const State& state, StateWriter& out) {
  out.addNumber(static_cast<std::uint32_t>(state.closed_grippers.size()));
  for (const ClosedGripper& gripper : state.closed_grippers) {
    out.addNumber(gripper.robot);
    out.addText(gripper.object);
    out.addPose(gripper.robot_from_object);
  }
}

void readGrippers(StateReader& in, std::size_t robots, State& state) {
  std::uint64_t next = 0;
  for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
    ClosedGripper& gripper = state.closed_grippers.emplace_back();
    gripper.robot = in.takeNumber<std::uint32_t>();
    requireContents(gripper.robot >= next && gripper.robot < robots, "a gripper is of an impossible robot");
    next = gripper.robot + std::uint64_t{1};
    gripper.object = in.takeText(kChangeBytesMax);
    gripper.robot_from_object = in.takePose();
  }
}

void writeInterventions(const State& state, StateWriter& out) {
  out.addNumber(state.interventions_applied);
  out.addNumber(static_cast<std::uint32_t>(state.interventions.size()));
  for (const AppliedIntervention& applied : state.interventions) {
    out.addNumber(applied.step);
    writeIntervention(applied.intervention, out);
  }
  writeObjects(state.objects, out);
  writeSpeeds(state, out);
  out.addNumber(std::uint8_t{state.communication.has_value()});
  if (state.communication) out.addText(changeText(ChangeRadio{*state.communication}));
  out.addNumber(std::uint8_t{state.ended.has_value()});
  if (state.ended) {
    out.addNumber(state.ended->step);
    out.addText(changeText(EndRun{state.ended->outcome, state.ended->text}));
  }
}

void readInterventions(StateReader& in, State& state) {
  state.interventions_applied = in.takeNumber<std::uint64_t>();
  for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
    AppliedIntervention& applied = state.interventions.emplace_back();
    applied.step = in.takeNumber<std::uint64_t>();
    requireContents(applied.step == state.time.step || applied.step == state.time.step + 1,
                    "an intervention has an impossible time");
    applied.intervention = readIntervention(in);
  }
  state.objects = readObjects(in);
  readSpeeds(in, state);
  if (in.takeFlag()) state.communication = takeChangeOf<ChangeRadio>(in).communication;
  if (in.takeFlag()) {
    const auto step = in.takeNumber<std::uint64_t>();
    requireContents(step <= state.time.step, "the end has an impossible time");
    const EndRun end = takeChangeOf<EndRun>(in);
    state.ended = RunEnd{end.outcome, end.text, step};
  }
}

}  // namespace robosim
