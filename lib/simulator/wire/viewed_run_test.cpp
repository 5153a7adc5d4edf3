#include "wire/viewed_run.h"

#include <functional>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "net/wire_error.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

const WorldSource& smallMaze() {
  static const WorldSource source = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  return source;
}

/// The first frame of the small maze, with a Pioneer and a Scout.
v1::Frame firstFrame() {
  v1::Frame frame;
  encode(smallMaze(), *frame.mutable_world()->mutable_source());
  frame.mutable_world()->set_world_version("v");
  frame.mutable_world()->set_period_s(0.1);
  for (std::size_t i = 0; i < 2; ++i) encode(RobotSnapshot{}, i, *frame.add_robots());
  return frame;
}

ViewedRun runAfter(const v1::Frame& frame) {
  ViewedRun run;
  update(run, frame);
  return run;
}

std::vector<Readings> readingsOfTheMaze() {
  LoadedWorld world = loadWorld(smallMaze(), {});
  return Environment(std::move(world.world), std::move(world.fleet), {}).state().readings;
}

/// Adds readings for a viewer that has received none.
void add(const std::vector<Readings>& readings, const ReadingsSelection& selection, v1::Frame& out) {
  SentSteps sent_steps(readings.size());
  encode(readings, selection, sent_steps, out);
}

TEST(ViewedRun, HasTheObjectsOfTheLastFrameWithAny) {
  ViewedRun run = runAfter(firstFrame());
  EXPECT_FALSE(run.snapshot.objects.areChanged());
  const auto& of_world = run.world.world.objects;
  const ChangedObjects moved(withChange(of_world, PlaceBody{of_world[0].name, 1.0 / 3, -2, 0.7}));
  v1::Frame frame;
  encode(moved, of_world, frame);
  EXPECT_FALSE(frame.has_objects());
  EXPECT_EQ(frame.moved_objects_size(), 1) << "the place of the only one that has moved";
  update(run, frame);
  EXPECT_EQ(run.snapshot.objects, moved);
  update(run, v1::Frame());
  EXPECT_EQ(run.snapshot.objects, moved) << "those of a frame without any are unchanged";
  frame.Clear();
  encode(ChangedObjects(), moved.orThose({}), frame);
  update(run, frame);
  EXPECT_FALSE(run.snapshot.objects.areChanged());
  frame.mutable_objects()->set_are_of_world(false);
  frame.mutable_objects()->add_elements("<remove name='a'/>");
  EXPECT_THROW(update(run, frame), WireError);
}

TEST(ViewedRun, HasTheRobotsThatHaveBeenAddedWithTheirFrame) {
  ViewedRun run = runAfter(firstFrame());
  ASSERT_EQ(run.world.fleet.robots.size(), 2u);
  v1::Frame frame = firstFrame();
  frame.mutable_world()->add_added_robots(changeText(AddRobot{"new", "scout", {1, 2, 0}}));
  EXPECT_THROW(update(run, frame), WireError) << "it does not show the new one";
  encode(RobotSnapshot{}, 2, *frame.add_robots());
  EXPECT_TRUE(update(run, frame));
  ASSERT_EQ(run.snapshot.robots.size(), 3u);
  EXPECT_EQ(run.world.fleet.robots[2].info.name, "new");
  EXPECT_EQ(run.world.fleet.robots[2].info.type->model, "scout");
  frame.mutable_world()->set_added_robots(0, "<remove name='a'/>");
  EXPECT_THROW(update(run, frame), WireError);
}

TEST(ViewedRun, HasTheReadingsOfAFrameForThatFrameOnly) {
  const std::vector<Readings> measured = readingsOfTheMaze();
  ViewedRun run = runAfter(firstFrame());
  EXPECT_EQ(run.readingsOf(0), nullptr);
  v1::Frame frame;
  frame.set_step(7);
  add(measured, ReadingsSelection{.of_all = false, .of = {1}}, frame);
  EXPECT_FALSE(update(run, frame));
  EXPECT_EQ(run.readingsOf(0), nullptr);
  ASSERT_NE(run.readingsOf(1), nullptr);
  EXPECT_EQ(run.readingsOf(1)->measurements, measured[1].measurements);
  EXPECT_DOUBLE_EQ(run.readingsOf(1)->time.seconds(), 0.7);
  update(run, v1::Frame());
  EXPECT_EQ(run.readingsOf(1), nullptr);
}

TEST(ViewedRun, UsesTheMemoryOfFormerReadingsAgain) {
  const std::vector<Readings> measured = readingsOfTheMaze();
  ViewedRun run = runAfter(firstFrame());
  v1::Frame with_readings;
  add(measured, ReadingsSelection{.of_all = false, .of = {1}}, with_readings);
  update(run, with_readings);
  run.snapshot.robots[1].readings->measurements.reserve(1000);
  for (const auto& frame : {with_readings, v1::Frame(), with_readings}) update(run, frame);
  EXPECT_GE(run.readingsOf(1)->measurements.capacity(), 1000u);
  EXPECT_EQ(run.readingsOf(1)->measurements, measured[1].measurements);
  update(run, firstFrame());  // another world
  update(run, with_readings);
  EXPECT_LT(run.readingsOf(1)->measurements.capacity(), 1000u);
}

TEST(ViewedRun, OfAllRobotsHasTheReadingsOfEach) {
  const std::vector<Readings> measured = readingsOfTheMaze();
  v1::Frame frame = firstFrame();
  add(measured, ReadingsSelection{.of_all = true, .of = {}}, frame);
  const ViewedRun run = runAfter(frame);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_NE(run.readingsOf(i), nullptr);
    EXPECT_EQ(run.readingsOf(i)->measurements, measured[i].measurements);
  }
}

TEST(ViewedRun, MarksAMeasurementAsNewOnceForEachViewer) {
  std::vector<Readings> measured = readingsOfTheMaze();
  SentSteps sent_steps(measured.size());
  const auto is_new = [&](const std::vector<std::uint32_t>& robots) {
    v1::Frame frame;
    encode(measured, ReadingsSelection{.of_all = false, .of = robots}, sent_steps, frame);
    std::vector<bool> answers;
    for (const auto& robot : frame.readings()) answers.push_back(robot.readings().measurements(0).is_new());
    return answers;
  };
  EXPECT_EQ(is_new({0}), std::vector<bool>{true});
  EXPECT_EQ(is_new({0, 1}), (std::vector<bool>{false, true})) << "another selection at the same step";
  EXPECT_EQ(is_new({1}), std::vector<bool>{false});
  EXPECT_EQ(is_new({0}), std::vector<bool>{false}) << "selected again";
  for (auto& readings : measured) ++readings.time.step;
  EXPECT_EQ(is_new({0, 1}), (std::vector<bool>{true, true}));
}

TEST(ViewedRun, DecodesASelectionWithoutDuplicatesAndUnknownRobots) {
  v1::FrameRequest request;
  encode(ReadingsSelection{.of_all = false, .of = {1, 0, 1, 99}}, request);
  const ReadingsSelection wish = decode(request, 2);
  EXPECT_EQ(wish.of, (std::vector<std::uint32_t>{0, 1}));
  v1::Frame frame;
  add(readingsOfTheMaze(), wish, frame);
  ASSERT_EQ(frame.readings_size(), 2);
  EXPECT_EQ(frame.readings(1).world_robot(), 1u);
}

TEST(ViewedRun, RefusesInvalidFrames) {
  const auto complaint = [](const std::function<void(v1::Frame&)>& spoil) {
    v1::Frame frame = firstFrame();
    add(readingsOfTheMaze(), ReadingsSelection{.of_all = true, .of = {}}, frame);
    spoil(frame);
    try {
      runAfter(frame);
    } catch (const WireError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](v1::Frame&) {}), "");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_robots(0)->set_world_robot(2); }),
            "a frame with a robot that the world does not have");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_readings(0)->set_world_robot(2); }),
            "a frame with a robot that the world does not have");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_robots(0)->set_x_m(NAN); }),
            "a frame with a pose that is not finite");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_robots(0)->set_activity(static_cast<v1::Activity>(9)); }),
            "a frame with the unknown activity 9");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_robots()->RemoveLast(); }),
            "a first frame that shows 1 of 2 robots");
  EXPECT_EQ(complaint([](v1::Frame& f) { f.mutable_world()->set_period_s(0); }),
            "a frame whose time step is not in (0, 1] s");
  EXPECT_NE(complaint([](v1::Frame& f) { f.mutable_readings(0)->mutable_readings()->clear_measurements(); }), "");
}

}  // namespace
}  // namespace robosim
