#include "server/geometry_wire.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

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

wire::TaskResult emptyResult(wire::StepPart part, std::uint32_t begin, std::uint32_t end) {
  wire::TaskResult result;
  result.set_part(part);
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

TEST(GeometryWire, CarriesAMomentBitForBit) {
  const auto environment = maze();
  environment->setCommand(0, {0.5, 0.25, 0, Activity::active});
  for (int i = 0; i < 5; ++i) environment->step();
  const Moment moment = environment->moment();
  wire::Moment wire;
  encode(moment, wire);
  const Moment heard = decode(wire, 2);
  EXPECT_EQ(heard.step, 5u);
  EXPECT_EQ(heard.world_from_robot, moment.world_from_robot);
  EXPECT_EQ(heard.speed_mps, moment.speed_mps);
  EXPECT_EQ(heard.turn_radps, moment.turn_radps);
  EXPECT_EQ(heard.activity, moment.activity);
  EXPECT_EQ(heard.commands, moment.commands);
}

TEST(GeometryWire, RefusesAMomentOfAnotherWorldOrThatIsNotFinite) {
  wire::Moment good;
  encode(maze()->moment(), good);
  const auto complaint_after = [&](const std::function<void(wire::Moment&)>& spoil) {
    wire::Moment bad = good;
    spoil(bad);
    return complaint([&] { decode(bad, 2); });
  };
  EXPECT_EQ(complaint_after([](auto&) {}), "");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.add_robots(); }), "a moment of another world");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_robots(1)->set_phi_rad(kNan); }),
            "a robot's state that is not finite");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_robots(0)->set_activity(static_cast<wire::Activity>(9)); }),
            "a moment with an unknown activity");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_robots(0)->mutable_command()->set_speed_mps(kNan); }), "");
}

TEST(GeometryWire, CarriesWhatWasSensed) {
  const auto here = maze(), there = maze();
  for (const auto& environment : {here.get(), there.get()}) {
    environment->begin();
    environment->clip({0, 2});
    environment->judge({0, 2});
    environment->move();
  }
  there->sense({0, 2});
  wire::TaskResult result = emptyResult(wire::SENSE, 1, 2);
  encode(*there, result);
  put(result, *here);
  for (std::size_t slot = 0; slot < there->state().readings[1].measurements.size(); ++slot) {
    EXPECT_EQ(here->measurement(1, slot), there->measurement(1, slot)) << slot;
  }
}

TEST(GeometryWire, RefusesResultsOfAnotherSizeForOtherRobotsOrOutOfRange) {
  const auto environment = maze();
  environment->begin();
  const auto complaint_of = [&](const wire::TaskResult& result) {
    return complaint([&] { put(result, *environment); });
  };

  wire::TaskResult clips = emptyResult(wire::CLIP, 0, 2);
  clips.add_fractions(1);
  EXPECT_EQ(complaint_of(clips), "a result of another size than its range");
  for (const double bad : {kNan, -0.01, 1.01}) {
    wire::TaskResult wrong = clips;
    wrong.add_fractions(bad);
    EXPECT_EQ(complaint_of(wrong), "a part of a way that is not in [0, 1]");
  }
  wire::TaskResult stay = emptyResult(wire::JUDGE, 0, 1);
  stay.add_stay(1);
  EXPECT_EQ(complaint_of(stay), "a robot of the number 1 where those of [0, 1) are meant");

  wire::TaskResult sensed = emptyResult(wire::SENSE, 0, 1);
  encode(*environment, sensed);
  EXPECT_EQ(complaint_of(sensed), "");
  wire::TaskResult more = sensed, fewer = sensed;
  more.add_measurements();
  fewer.mutable_measurements()->RemoveLast();
  EXPECT_EQ(complaint_of(more), "a result with too many measurements");
  EXPECT_EQ(complaint_of(fewer), "a result with too few measurements");
}

TEST(GeometryWire, CarriesTheOutcomeOfThePartBefore) {
  const auto here = maze(), there = maze();
  here->begin();
  there->begin();
  here->putClipped(0, 0.25);
  here->putClipped(1, 1);
  wire::Task task;
  task.set_part(wire::JUDGE);
  encodeOutcome(*here, task);
  EXPECT_EQ(task.clipped_size(), 1) << "only the one that is clipped is told";
  putOutcome(task, *there);
  EXPECT_EQ(there->clipped(0), 0.25);
  EXPECT_EQ(there->clipped(1), 1);

  task.add_clipped(1);
  EXPECT_EQ(complaint([&] { putOutcome(task, *there); }), "clipped robots without their fractions");
  task.add_clipped_fractions(2);
  EXPECT_EQ(complaint([&] { putOutcome(task, *there); }), "a part of a way that is not in [0, 1]");
}

}  // namespace
}  // namespace robosim
