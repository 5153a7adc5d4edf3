#include "sensors/camera_head.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/camera.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

std::unique_ptr<Sensor> headFrom(const std::string& ptz) {
  return makeHeadOf(*sensorFrom("<camera>" + ptz + "</camera>"));
}

CameraHeadLimits limitsFrom(const std::string& ptz) { return headFrom(ptz)->info().head; }

std::string headError(const std::string& ptz) {
  try {
    sensorFrom("<camera>" + ptz + "</camera>");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

CameraAim aimOf(const Measurement& measured) { return CameraAim::from(std::get<Values>(measured)); }

constexpr double kDeg = kRadPerDeg;

TEST(CameraHead, HasTheLimitsOfItsModel) {
  const CameraHeadLimits canon = limitsFrom("<ptz/>");
  EXPECT_EQ(canon, limitsFrom("<ptz model='vcc4'/>"));
  EXPECT_DOUBLE_EQ(canon.pan_min_rad, -100 * kDeg);
  EXPECT_DOUBLE_EQ(canon.pan_max_rad, 100 * kDeg);
  EXPECT_DOUBLE_EQ(canon.tilt_min_rad, -30 * kDeg);
  EXPECT_DOUBLE_EQ(canon.tilt_max_rad, 90 * kDeg);
  EXPECT_DOUBLE_EQ(canon.pan_radps, 90 * kDeg);
  EXPECT_DOUBLE_EQ(canon.tilt_radps, 70 * kDeg);
  EXPECT_EQ(canon.zoom_max, 16);
  EXPECT_EQ(canon.zoom_per_s, 5);
  const CameraHeadLimits sony = limitsFrom("<ptz model='evid30' tilt_max_deg='20' pan_degps='10' zoom_per_s='2'/>");
  EXPECT_DOUBLE_EQ(sony.tilt_min_rad, -25 * kDeg);
  EXPECT_DOUBLE_EQ(sony.tilt_max_rad, 20 * kDeg);
  EXPECT_DOUBLE_EQ(sony.pan_radps, 10 * kDeg);
  EXPECT_DOUBLE_EQ(sony.tilt_radps, 50 * kDeg);
  EXPECT_EQ(sony.zoom_max, 12);
  EXPECT_EQ(sony.zoom_per_s, 2);
}

TEST(CameraHead, MovesAtTheSpeedOfEachAxisAndStopsAtItsTarget) {
  const auto head = headFrom("<ptz pan_degps='40' tilt_degps='20' zoom_per_s='3'/>");
  SingleRobotScene robot({});  // steps of 0.1 s
  robot.command.camera_head.edit().aim = {30 * kDeg, -15 * kDeg, 2};
  for (int step = 1; step <= 12; ++step) {
    const CameraAim aim = aimOf(robot.sense(*head));
    EXPECT_NEAR(aim.pan_rad, std::min(4 * step, 30) * kDeg, 1e-12) << step;
    EXPECT_NEAR(aim.tilt_rad, -std::min(2 * step, 15) * kDeg, 1e-12) << step;
    EXPECT_NEAR(aim.zoom, std::min(1 + 0.3 * step, 2.0), 1e-12) << step;
  }
  EXPECT_EQ(aimOf(robot.sense(*head)), robot.command.camera_head->aim) << "exactly";
  robot.command.camera_head.edit().aim = {};
  EXPECT_NEAR(aimOf(robot.sense(*head)).pan_rad, 26 * kDeg, 1e-12) << "back";
}

TEST(CameraHead, MovesAtACommandedSpeedBelowItsOwn) {
  const CameraHeadLimits limits = limitsFrom("<ptz pan_degps='40' tilt_degps='20'/>");
  const auto moved = [&](double pan_degps, double tilt_degps) {
    const CameraAim aim = movedTowards({{-1, 1, 1}, pan_degps * kDeg, tilt_degps * kDeg}, {}, limits, 0.5);
    return std::pair{std::round(aim.pan_rad / kDeg * 1e9) / 1e9, std::round(aim.tilt_rad / kDeg * 1e9) / 1e9};
  };
  EXPECT_EQ(moved(10, 5), std::pair(-5.0, 2.5));
  EXPECT_EQ(moved(100, 0), std::pair(-20.0, 10.0)) << "more than it can, and none";
  EXPECT_EQ(moved(-3, 20), std::pair(-20.0, 10.0));
}

TEST(CameraHead, StaysWithinItsLimits) {
  const CameraHeadLimits limits = limitsFrom("<ptz pan_min_deg='-10' pan_max_deg='20' zoom_max='4'/>");
  constexpr double kLong_s = 100;
  EXPECT_EQ(movedTowards({{-9, -9, 0}}, {}, limits, kLong_s), (CameraAim{limits.pan_min_rad, limits.tilt_min_rad, 1}));
  EXPECT_EQ(movedTowards({{9, 9, 99}}, {}, limits, kLong_s), (CameraAim{limits.pan_max_rad, limits.tilt_max_rad, 4}));
}

TEST(CameraHead, MeasuresNoNegativeZeroWhichSavedCommandsLack) {
  const CameraHeadLimits limits = limitsFrom("<ptz/>");
  const CameraAim aim = movedTowards({{-0.0, -0.0, 1}}, {}, limits, 1);
  EXPECT_FALSE(std::signbit(aim.pan_rad) || std::signbit(aim.tilt_rad));
}

TEST(CameraHead, MovesOnFromAnAimBeyondItsLimitsAsFromTheNearestWithin) {
  const CameraHeadLimits limits = limitsFrom("<ptz zoom_per_s='0.1'/>");
  EXPECT_EQ(movedTowards({{0, 0, 1}}, {0, 9, -3}, limits, 1e-9).zoom, 1);
  EXPECT_NEAR(movedTowards({{0, 9, 1}}, {0, 9, 1}, limits, 1).tilt_rad, limits.tilt_max_rad, 1e-12);
}

TEST(CameraHead, IsASensorOfItsOwnAndOnlyOfCamerasThatHaveOne) {
  const auto head = headFrom("<ptz/>");
  EXPECT_EQ(head->info().label, "ptz");
  EXPECT_EQ(head->info().kind, SensorKind::values);
  EXPECT_TRUE(CameraAim::isOf(head->info()));
  EXPECT_EQ(aimOf(head->blank()), CameraAim{});
  EXPECT_FALSE(headFrom(""));
  EXPECT_FALSE(makeHeadOf(*sensorFrom("<compass/>")));
  EXPECT_TRUE(sensorFrom("<camera><ptz/></camera>")->info().pans);
  EXPECT_FALSE(sensorFrom("<camera/>")->info().pans);
}

TEST(CameraHead, ExplainsWrongSettings) {
  EXPECT_EQ(headError("<ptz model='axis'/>"),
            "sensor.xml:1: <ptz model=\"axis\">: is unknown; accepted are: vcc4, evid30");
  EXPECT_EQ(headError("<ptz pan_min_deg='10'/>"),
            "sensor.xml:1: <ptz pan_min_deg=\"10\">: must lie in [-360, 0] degrees; drop it for the default, -100");
  EXPECT_EQ(headError("<ptz zoom_max='0.5'/>"),
            "sensor.xml:1: <ptz zoom_max=\"0.5\">: must lie in [1, 100]; drop it for the default, 16");
  EXPECT_EQ(headError("<ptz/><ptz/>"), "sensor.xml:1: <ptz>: is given twice in <camera>; keep one");
  const auto first = std::shared_ptr<const Sensor>(headFrom("<ptz/>"));
  try {
    sensorFrom("<camera><ptz/></camera>", {.mounted = {&first, 1}});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "sensor.xml:1: <camera>: is the second camera with a <ptz> of its robot; a controller commands one, so "
        "drop one <ptz>");
  }
}

}  // namespace
}  // namespace robosim
