#include "viewing/body_dragging.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using How = BodyDragging::How;

/// 10 m × 10 m with a box of 2 m × 1 m at (3, 3) and a robot at (7, 7). It makes every change but those that `fault`
/// refuses.
class ChangeableRun final : public ViewSource {
 public:
  ChangeableRun() {
    world_.world.bounds = {0, 10, 0, 10};
    world_.world.objects.resize(1);
    world_.world.objects[0].name = "box";
    world_.world.objects[0].body = {Cube{2, 1}, {3, 3, 0}, 0.5, 1};
    FleetRobot robot;
    robot.info.name = "Ann";
    robot.info.radius_m = 0.25;
    robot.info.sensors = std::make_shared<const std::vector<SensorInfo>>();
    robot.own_body.emplace().height_m = 0.2;
    world_.fleet.robots.push_back(robot);
    shown.robots.emplace_back().world_from_robot = {7, 7, 0};
  }
  const LoadedWorld& world() const override { return world_; }
  const RunSnapshot& snapshot() const override { return shown; }
  const RunPaths& paths() const override { return paths_; }
  std::string title() const override { return "run"; }
  bool advance(double) override { return false; }
  bool isOver() const override { return false; }
  std::string whyUnchangeable() const override { return unchangeable; }
  void change(const Change& change) override {
    changes.push_back(change);
    answers_.push_back(fault);
    if (!fault.empty()) return;
    const auto& place = std::get<PlaceBody>(change);
    auto& pose = shown.robots[0].world_from_robot;
    if (place.name == "Ann") pose = {place.x_m, place.y_m, place.heading_rad.value_or(pose.phi)};
    shown.objects = ChangedObjects(withChange(shown.objects.orThose(world_.world.objects), change));
  }
  std::vector<std::string> takeAnswers() override { return std::exchange(answers_, {}); }

  RunSnapshot shown;
  std::string unchangeable, fault;
  std::vector<Change> changes;

 private:
  LoadedWorld world_;
  RunPaths paths_;
  std::vector<std::string> answers_;
};

/// A window of 548 × 548 pixels, of which a margin of 24 is outside: 50 pixels per metre.
struct Window {
  ChangeableRun run;
  ViewDrawing drawing{run, [](const LoadedWorld& world, AbsentRobots) {
                        return std::vector{makePane(false, std::nullopt, world.world)};
                      }};
  BodyDragging dragging{run, drawing};

  Window() { drawing.draw({548, 548}); }
  static TPoint2D pixel(double x, double y) { return {273.5 + 50 * (x - 5), 273.5 - 50 * (y - 5)}; }
  /// Presses the button at a place of the world, and releases it at another.
  bool drag(How how, const TPoint2D& from, const TPoint2D& to) {
    if (!dragging.press(pixel(from.x, from.y), how)) return false;
    dragging.drag(pixel(to.x, to.y));
    dragging.release();
    return true;
  }
  PlaceBody lastPlace() const { return std::get<PlaceBody>(run.changes.back()); }
};

TEST(BodyDragging, MovesWhatIsUnderTheMouseByTheWayOfTheMouse) {
  Window window;
  EXPECT_TRUE(window.drag(How::move, {3.5, 3.2}, {6.5, 2.2}));
  EXPECT_EQ(window.lastPlace().name, "box");
  EXPECT_NEAR(window.lastPlace().x_m, 6, 1e-9);
  EXPECT_NEAR(window.lastPlace().y_m, 2, 1e-9);
  EXPECT_FALSE(window.lastPlace().heading_rad);
  EXPECT_EQ(window.dragging.takeNotice(), "'box' is at x 6.00 m, y 2.00 m, 0°");
  EXPECT_EQ(window.dragging.takeNotice(), "") << "said once";
}

TEST(BodyDragging, TurnsTheFrontTowardsTheMouse) {
  Window window;
  EXPECT_TRUE(window.drag(How::turn, {7.1, 7}, {7, 9}));
  EXPECT_EQ(window.lastPlace().name, "Ann");
  EXPECT_EQ(window.lastPlace().x_m, 7);
  EXPECT_EQ(window.lastPlace().y_m, 7);
  EXPECT_NEAR(*window.lastPlace().heading_rad, M_PI / 2, 1e-9);
}

TEST(BodyDragging, UndoesAMoveByPlacingTheBodyWhereItWas) {
  Window window;
  window.drag(How::move, {3, 3}, {6, 2});
  window.drag(How::turn, {6, 2}, {6, 4});
  window.dragging.undo();
  window.dragging.undo();
  EXPECT_EQ(window.lastPlace(), (PlaceBody{"box", 3, 3, 0.0}));
  EXPECT_EQ(window.dragging.takeNotice(), "undone: 'box' is back at x 3.00 m, y 3.00 m, 0°");
}

TEST(BodyDragging, SaysWhyAMoveIsRefused) {
  Window window;
  window.run.fault = "'box' would overlap 'Ann'; choose another place";
  window.drag(How::move, {3, 3}, {7, 7});
  EXPECT_EQ(window.dragging.takeNotice(), window.run.fault);
  window.dragging.undo();
  EXPECT_EQ(window.dragging.takeNotice(), "there is nothing to undo");
  EXPECT_EQ(window.run.changes.size(), 1u);
}

TEST(BodyDragging, ShowsTheOutlineWhereTheBodyWouldBe) {
  Window window;
  window.dragging.press(Window::pixel(3, 3), How::move);
  EXPECT_FALSE(window.dragging.outline()) << "before the mouse has moved";
  window.dragging.drag(Window::pixel(5, 5));
  const auto outline = window.dragging.outline();
  ASSERT_TRUE(outline);
  ASSERT_EQ(outline->rims.size(), 1u);
  ASSERT_EQ(outline->rims[0].size(), 4u);
  // A corner at (6, 5.5).
  EXPECT_NEAR(outline->rims[0][0].x, 273.5 + 50, 1e-9);
  EXPECT_NEAR(outline->rims[0][0].y, 273.5 - 25, 1e-9);
  EXPECT_TRUE(window.run.changes.empty());
  window.dragging.cancel();
  window.dragging.release();
  EXPECT_TRUE(window.run.changes.empty());
}

TEST(BodyDragging, LeavesClicksAndEmptyPlacesAlone) {
  Window window;
  EXPECT_FALSE(window.drag(How::move, {5, 5}, {6, 6}));
  EXPECT_TRUE(window.drag(How::move, {3, 3}, {3.05, 3})) << "2.5 pixels";
  EXPECT_TRUE(window.run.changes.empty());
}

TEST(BodyDragging, SaysWhyTheSourceCannotBeChanged) {
  Window window;
  window.run.unchangeable = "the run is over";
  EXPECT_TRUE(window.drag(How::move, {3, 3}, {6, 2}));
  EXPECT_EQ(window.dragging.takeNotice(), "the run is over");
  EXPECT_TRUE(window.run.changes.empty());
}

TEST(BodyDragging, EndsWhenTheBodyLeavesTheWorld) {
  Window window;
  window.dragging.press(Window::pixel(3, 3), How::move);
  window.run.shown.objects = ChangedObjects(std::vector<WorldObject>());
  window.dragging.update();
  EXPECT_FALSE(window.dragging.isDragging());
}

TEST(BodyDragging, KeepsWhatTheRunDoesToADraggedBody) {
  Window window;
  window.dragging.press(Window::pixel(7, 7), How::move);
  window.dragging.drag(Window::pixel(8, 8));
  window.run.shown.robots[0].world_from_robot = {7.5, 7, 1};  // it has driven on
  window.dragging.update();
  window.dragging.release();
  EXPECT_EQ(window.lastPlace().name, "Ann");
  EXPECT_NEAR(window.lastPlace().x_m, 8, 1e-9);
  EXPECT_FALSE(window.lastPlace().heading_rad);
  window.dragging.undo();
  EXPECT_EQ(window.lastPlace(), (PlaceBody{"Ann", 7.5, 7, 1.0}));
}

}  // namespace
}  // namespace robosim
