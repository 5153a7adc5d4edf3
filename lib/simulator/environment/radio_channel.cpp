#include "environment/radio_channel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/portable_math.h"
#include "base/random.h"
#include "geometry/shapes/ray.h"

namespace robosim {
namespace {

constexpr double kStepTolerance = 1e-6;  // of a step; absorbs the rounding error of the time
/// Length of a gap that is none [m]: absorbs the rounding errors of solids that touch.
constexpr double kGapTolerance_m = 1e-6;

}  // namespace

MessageFate RadioChannel::decideFate(std::uint64_t seed, const SimTime& now, const Scene& scene, const Way& way) const {
  const Communication& c = communication_;
  const auto& a = way.from_antenna;
  const auto& b = way.to_antenna;
  const double distance_m = c.range_m ? portable::hypot(a.x - b.x, a.y - b.y) : 0;
  if (c.range_m && distance_m > *c.range_m) return MessageFate::out_of_range;
  const int walls = c.hasWalls() ? wallsBetween(scene, a, b, robots_) : 0;
  if (c.range_m && distance_m + walls * c.wall_range_m > *c.range_m) return MessageFate::stopped_by_walls;
  Rng rng(seed, RandomPurpose::message_loss, way.from, static_cast<std::uint32_t>(way.index), now.step);
  if (c.loss_probability > 0 && rng.uniform() < c.loss_probability) return MessageFate::lost_by_chance;
  if (c.wall_loss > 0) {
    for (int i = 0; i < walls; ++i) {
      if (rng.uniform() < c.wall_loss) return MessageFate::stopped_by_walls;
    }
  }
  if (c.hasBursts() && rng.uniform() < c.burst_loss && isBad(seed, now, way.from, way.to))
    return MessageFate::lost_in_burst;
  return MessageFate::arrives;
}

bool RadioChannel::isBad(std::uint64_t seed, const SimTime& now, std::uint32_t a, std::uint32_t b) const {
  double to_bad = now.period_s / communication_.burst_gap_s, to_good = now.period_s / communication_.burst_s;
  if (const double sum = to_bad + to_good; sum > 1) {
    to_bad /= sum;
    to_good /= sum;
  }
  const auto first = std::min(a, b), second = std::max(a, b);
  for (std::uint64_t step = now.step; step > 0; --step) {
    const double number = Rng(seed, RandomPurpose::radio_burst, first, second, step).uniform();
    if (number < to_bad) return true;
    if (number < to_bad + to_good) return false;
  }
  return Rng(seed, RandomPurpose::radio_burst, first, second, 0).uniform() < to_bad / (to_bad + to_good);
}

int RadioChannel::wallsBetween(const Scene& scene, const mrpt::math::TPoint3D& a, const mrpt::math::TPoint3D& b,
                               std::size_t robots) {
  const auto out = b - a;
  const double length_m = portable::hypot(portable::hypot(out.x, out.y), out.z);
  if (length_m == 0) return 0;
  const Ray ray{a, out * (1 / length_m)};
  static thread_local std::vector<BodyId> near;
  near.clear();
  scene.findBodies({std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)}, near);
  static thread_local std::vector<RaySpan> occupied;
  occupied.clear();
  for (const BodyId body : near) {
    if (static_cast<std::size_t>(body) >= scene.stationaryCount() && scene.movingIndex(body) < robots) continue;
    const auto span = spanInside(ray, scene.solid(body));
    if (span && span->to_m >= 0 && span->from_m < length_m) occupied.push_back(*span);
  }
  std::sort(occupied.begin(), occupied.end(), [](const RaySpan& x, const RaySpan& y) { return x.from_m < y.from_m; });
  int walls = 0;
  double end_m = -std::numeric_limits<double>::infinity();
  for (const RaySpan& span : occupied) {
    walls += span.from_m > end_m + kGapTolerance_m ? 1 : 0;
    end_m = std::max(end_m, span.to_m);
  }
  return walls;
}

std::uint64_t delaySteps(const Communication& communication, double period_s) {
  if (communication.delay_s == 0) return 0;
  return static_cast<std::uint64_t>(std::ceil(communication.delay_s / period_s - kStepTolerance));
}

std::uint64_t messagesAllowed(const Communication& communication, const SimTime& now) {
  if (communication.rate_hz == 0) return std::numeric_limits<std::uint64_t>::max();
  const auto until = [&](std::uint64_t step) {
    return std::floor(static_cast<double>(step) * now.period_s * communication.rate_hz + kStepTolerance);
  };
  return now.step == 0 ? 0 : static_cast<std::uint64_t>(until(now.step) - until(now.step - 1));
}

}  // namespace robosim
