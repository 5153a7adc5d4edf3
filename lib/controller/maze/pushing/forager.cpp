#include "maze/pushing/forager.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "base/random.h"
#include "maze/pushing/disc_pusher.h"
#include "maze/pushing/low_objects.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kNestInside_m = 0.15;  // distance inside the nest's edge to which pucks are pushed
constexpr double kSamePuck_m = 0.35;    // distance within which a puck in view is the one of the last step
constexpr double kPuckLost_s = 2;       // time without view after which a puck is lost
constexpr double kPuckPatience_s = 25;  // time without progress after which a puck is left
constexpr double kPuckIgnored_s = 60;   // time for which it is left then
constexpr double kPuckBackOff_s = 1.2;  // time for which the robot drives back from a puck
constexpr double kNestMargin_m = 0.4;   // distance from the nest that a robot without a puck keeps

double gapBetween(const TPoint2D& a, const TPoint2D& b) { return portable::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

Forager::Forager(const ControllerSetup& setup, const ForagerOptions& options)
    : setup_(setup), options_(options), tracker_(setup.world_from_start.value_or(TPose2D())) {}

double Forager::nestDistance(const TPoint2D& place) const { return gapBetween(place, options_.nest); }

void Forager::step(Robot& robot) {
  const TPose2D world_from_robot = tracker_.update(robot);
  if (robot.stepNumber() < back_until_) {
    backOff(robot);
    return;
  }
  if (robot.held()) {
    carry(robot, world_from_robot);
    return;
  }
  if (!selectPuck(robot, world_from_robot)) {
    robot.release();
    search(robot, world_from_robot);
    return;
  }
  const double distance_m = nestDistance(*puck_);
  if (distance_m < nearest_m_ - 0.1) {
    nearest_m_ = distance_m;
    progress_step_ = robot.stepNumber();
  }
  const bool is_stuck = robot.stepNumber() > progress_step_ + robot.stepsIn(kPuckPatience_s);
  if (is_stuck) ignored_.push_back({*puck_, robot.stepNumber() + robot.stepsIn(kPuckIgnored_s)});
  if (is_stuck || distance_m < options_.nest_radius_m - kNestInside_m) {
    puck_.reset();
    back_until_ = robot.stepNumber() + robot.stepsIn(kPuckBackOff_s);
    backOff(robot);
    return;
  }
  if (robot.hasGripper()) {
    gripDisc(robot, world_from_robot, *puck_, options_.puck_radius_m, options_.speed_mps);
    return;
  }
  pushDisc(robot, world_from_robot, {*puck_, options_.puck_radius_m, options_.nest}, options_.speed_mps);
}

std::vector<TPoint2D> Forager::pucksOutside(const Robot& robot, const TPose2D& world_from_robot) const {
  std::vector<TPoint2D> pucks;
  for (const TPoint2D& in_robot : lowObjects(robot, options_.puck_radius_m)) {
    const TPoint2D puck = portable::compose(world_from_robot, in_robot);
    if (nestDistance(puck) > options_.nest_radius_m - kNestInside_m) pucks.push_back(puck);
  }
  return pucks;
}

bool Forager::selectPuck(const Robot& robot, const TPose2D& world_from_robot) {
  const std::uint64_t now = robot.stepNumber();
  std::erase_if(ignored_, [&](const Ignored& ignored) { return ignored.until <= now; });
  if (puck_) {
    // Also inside the nest, where it is delivered.
    const TPoint2D* same = nullptr;
    const auto in_view = lowObjects(robot, options_.puck_radius_m);
    TPoint2D nearest;
    double nearest_m = kSamePuck_m;
    for (const TPoint2D& in_robot : in_view) {
      const TPoint2D place = portable::compose(world_from_robot, in_robot);
      const double apart_m = gapBetween(place, *puck_);
      if (apart_m >= nearest_m) continue;
      nearest_m = apart_m;
      nearest = place;
      same = &nearest;
    }
    if (same) {
      puck_ = *same;
      seen_step_ = now;
    } else if (now > seen_step_ + robot.stepsIn(kPuckLost_s)) {
      puck_.reset();
    }
    if (puck_) return true;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const TPoint2D& puck : pucksOutside(robot, world_from_robot)) {
    const bool is_ignored = std::any_of(ignored_.begin(), ignored_.end(), [&](const Ignored& ignored) {
      return gapBetween(ignored.place, puck) < kSamePuck_m;
    });
    const double way_m = gapBetween({world_from_robot.x, world_from_robot.y}, puck);
    const PushTask task{puck, options_.puck_radius_m, options_.nest};
    const double cost = way_m + 0.4 * std::abs(pushError(task, world_from_robot));
    if (is_ignored || cost >= least) continue;
    least = cost;
    puck_ = puck;
  }
  if (!puck_) return false;
  seen_step_ = progress_step_ = now;
  nearest_m_ = nestDistance(*puck_);
  return true;
}

void Forager::carry(Robot& robot, const TPose2D& world_from_robot) {
  puck_.reset();
  if (nestDistance({world_from_robot.x, world_from_robot.y}) > options_.nest_radius_m - kNestInside_m) {
    driveTo(robot, world_from_robot, options_.nest, options_.speed_mps, 0);
    return;
  }
  robot.release();
  back_until_ = robot.stepNumber() + robot.stepsIn(kPuckBackOff_s);
  backOff(robot);
}

void Forager::search(Robot& robot, const TPose2D& world_from_robot) {
  const TPoint2D from_nest = TPoint2D(world_from_robot.x, world_from_robot.y) - options_.nest;
  const double outward_rad = portable::atan2(from_nest.y, from_nest.x);
  const bool is_near_nest = nestDistance({world_from_robot.x, world_from_robot.y}) <
                            options_.nest_radius_m + robot.info().radius_m + kNestMargin_m;
  const bool leads_inward = std::abs(mrpt::math::wrapToPi(course_rad_ - outward_rad)) > 1.4;
  if (robot.stepNumber() >= course_until_ || robot.stalled() || (is_near_nest && leads_inward)) {
    Rng rng(setup_.seed, RandomPurpose::controller, setup_.robot, 0, robot.stepNumber());
    course_rad_ =
        is_near_nest ? outward_rad + rng.uniform(-1.2, 1.2) : rng.uniform(-std::numbers::pi, std::numbers::pi);
    course_until_ = robot.stepNumber() + robot.stepsIn(rng.uniform(3, 9));
  }
  driveTowards(robot, course_rad_ - world_from_robot.phi, options_.speed_mps);
}

void Forager::backOff(Robot& robot) { robot.drive(-0.6 * options_.speed_mps, 0); }

}  // namespace robosim
