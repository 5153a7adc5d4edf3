#include "wire/geometry_wire.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "environment/step_phases.h"
#include "net/wire_error.h"
#include "robots/world_source.h"

namespace robosim {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// The small maze: a Pioneer, which is robot 0, and a Scout.
std::unique_ptr<Environment> maze() {
  LoadedWorld world = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {});
  return std::make_unique<Environment>(std::move(world.world), std::move(world.fleet), EnvironmentOptions{});
}

internal::TaskResult emptyResult(std::uint32_t begin, std::uint32_t end) {
  internal::TaskResult result;
  result.set_begin(begin);
  result.set_end(end);
  return result;
}

std::string complaint(const std::function<void()>& read) {
  try {
    read();
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(GeometryWire, RoundTripsTheStateOfAReplicaBitForBit) {
  const auto environment = maze();
  environment->setCommand(0, {0.5, 0.25, 0, Activity::active});
  for (int i = 0; i < 5; ++i) environment->step();
  const State& sent = environment->state();
  internal::ReplicaState wire;
  encode(sent, wire);
  State received = maze()->state();
  decodeInto(wire, received);
  EXPECT_EQ(received.time.step, 5u);
  EXPECT_EQ(received.world_from_robot, sent.world_from_robot);
  EXPECT_EQ(received.speed_mps, sent.speed_mps);
  EXPECT_EQ(received.turn_radps, sent.turn_radps);
  EXPECT_EQ(received.activity, sent.activity);
  EXPECT_EQ(received.commands, sent.commands);
}

TEST(GeometryWire, RefusesAStateOfAnotherWorldOrThatIsNotFinite) {
  const auto environment = maze();
  internal::ReplicaState good;
  encode(environment->state(), good);
  const auto complaint_after = [&](const std::function<void(internal::ReplicaState&)>& spoil) {
    internal::ReplicaState bad = good;
    spoil(bad);
    State state = environment->state();
    return complaint([&] { decodeInto(bad, state); });
  };
  EXPECT_EQ(complaint_after([](auto&) {}), "");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.add_robots(); }), "a state of another world");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_robots(1)->set_phi_rad(kNan); }),
            "a robot's state that is not finite");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_robots(0)->set_activity(static_cast<v1::Activity>(9)); }),
            "a state with an unknown activity");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_robots(0)->mutable_command()->set_speed_mps(kNan); }), "");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.clear_objects(); }),
            "a state with invalid objects: they end too early");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_objects()->push_back('x'); }),
            "a state with objects of another form");
}

TEST(GeometryWire, RoundTripsMeasurements) {
  const auto here = maze(), there = maze();
  for (const auto& environment : {here.get(), there.get()}) {
    environment->phases().begin();
    environment->phases().clip({0, 2});
    environment->phases().judge({0, 2});
    environment->phases().move();
  }
  there->phases().sense({0, 2});
  internal::TaskResult result = emptyResult(1, 2);
  encode(*there, result);
  put(result, *here);
  EXPECT_EQ(here->state().readings[1].measurements, there->state().readings[1].measurements);
}

TEST(GeometryWire, LeavesTheBlankReadingsOfAnAbsentRobot) {
  const auto here = maze(), there = maze();
  for (const auto& environment : {here.get(), there.get()}) environment->remove(1);
  internal::TaskResult result = emptyResult(0, 2);
  encode(*there, result);
  const auto before = here->state().readings[1].measurements;
  EXPECT_EQ(complaint([&] { put(result, *here); }), "");
  EXPECT_EQ(here->state().readings[1].measurements, before);
}

TEST(GeometryWire, EncodesRangeSensorsOnly) {
  const auto environment = maze();
  internal::TaskResult result = emptyResult(0, 2);
  encode(*environment, result);
  for (const auto& measurement : result.measurements()) {
    EXPECT_GT(measurement.floats_size(), 0);
    EXPECT_EQ(measurement.doubles_size(), 0);
    EXPECT_TRUE(measurement.flags().empty());
  }
}

TEST(GeometryWire, RefusesResultsOfAnotherSizeOrImplausibleOnes) {
  const auto environment = maze();
  const auto complaint_of = [&](const internal::TaskResult& result) {
    return complaint([&] { put(result, *environment); });
  };
  internal::TaskResult sensed = emptyResult(0, 1);
  encode(*environment, sensed);
  EXPECT_EQ(complaint_of(sensed), "");
  internal::TaskResult more = sensed, fewer = sensed;
  more.add_measurements();
  fewer.mutable_measurements()->RemoveLast();
  EXPECT_EQ(complaint_of(more), "a result with too many measurements");
  EXPECT_EQ(complaint_of(fewer), "a result with too few measurements");
  for (const float bad : {-5.f, 1e30f, std::numeric_limits<float>::infinity()}) {
    internal::TaskResult wrong = sensed;
    wrong.mutable_measurements(0)->set_floats(0, bad);
    EXPECT_NE(complaint_of(wrong).find("beam 0: a range of "), std::string::npos) << complaint_of(wrong);
  }
  internal::TaskResult wrong = sensed;
  wrong.mutable_measurements(0)->set_floats(0, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(complaint_of(wrong), "beam 0: a range of nan m; it must be a finite number");
}

TEST(GeometryWire, RoundTripsTheMotionOfAllRobots) {
  const auto here = maze(), there = maze();
  here->phases().begin();
  there->phases().begin();
  here->phases().results().paths[0].end_fraction = 0.25;
  here->phases().results().stays[1] = 1;
  internal::Task task;
  encodeOutcome(*here, task);
  EXPECT_EQ(task.clipped_size(), 1) << "only the clipped one is sent";
  putOutcome(task, *there);
  EXPECT_EQ(there->phases().results().paths[0].end_fraction, 0.25);
  EXPECT_EQ(there->phases().results().paths[1].end_fraction, 1);
  EXPECT_EQ(there->phases().results().stays[0], 0);
  EXPECT_EQ(there->phases().results().stays[1], 1);

  internal::Task unknown = task;
  unknown.add_staying(2);
  EXPECT_EQ(complaint([&] { putOutcome(unknown, *there); }), "a robot of the number 2 where those of [0, 2) are meant");
  for (const double bad : {kNan, -0.01, 1.01}) {
    internal::Task wrong = task;
    wrong.add_clipped()->set_fraction(bad);
    EXPECT_EQ(complaint([&] { putOutcome(wrong, *there); }), "a part of a way that is not in [0, 1]");
  }
}

TEST(GeometryWire, RoundTripsCommands) {
  const auto environment = maze();
  internal::Task task;
  const Command command{.speed_mps = 0.5, .turn_radps = -0.25, .by_driver = true, .led_color = 0x102030};
  addCommand(1, command, task);
  putCommands(task, *environment);
  EXPECT_EQ(environment->state().commands[1], command);
  addCommand(2, command, task);
  EXPECT_EQ(complaint([&] { putCommands(task, *environment); }),
            "a robot of the number 2 where those of [0, 2) are meant");
}

}  // namespace
}  // namespace robosim
