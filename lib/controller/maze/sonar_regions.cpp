#include "maze/sonar_regions.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr double kSame_m = 0.03, kSamePerM = 0.03;  // greatest difference of distances in a region
constexpr double kAdjacentCos = 0.76;               // of the largest angle between adjacent sonars of a region: 40.5°
constexpr double kRegionCos = 0.17;                 // of its whole angle: 80°
constexpr double kRegionStd_m = 0.05;
constexpr double kReach_m = 2.5;  // farther regions say little about their direction
constexpr double kBlind_m = 0.3;  // shorter readings may be repetitions of echoes closer than the blanking
constexpr double kOpen = 0.85;    // share of a ray that is taken to be free, for the width of the beam
constexpr double kOpenMax_m = 2.5;
constexpr double kBesideCos = 0.17;   // of the angle to a surface beyond which it does not end a ray: 80°
constexpr std::uint32_t kAgeMax = 5;  // steps

}  // namespace

void SonarRegions::order(const SensorInfo& sensor) {
  readings_.resize(sensor.beams.size());
  by_bearing_.resize(sensor.beams.size());
  for (std::size_t i = 0; i < by_bearing_.size(); ++i) by_bearing_[i] = i;
  std::stable_sort(by_bearing_.begin(), by_bearing_.end(), [&](std::size_t a, std::size_t b) {
    return sensor.beams[a].robot_from_beam.yaw < sensor.beams[b].robot_from_beam.yaw;
  });
}

void SonarRegions::update(const SensorInfo& sensor, const Echoes& echoes, const mrpt::math::TPose2D& pose) {
  if (readings_.size() != echoes.size()) order(sensor);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    Reading& reading = readings_[i];
    ++reading.age;
    if (echoes[i].range_m == reading.range_m && (isEcho(sensor, echoes[i]) || reading.age <= kAgeMax)) continue;
    const auto& mount = sensor.beams[i].robot_from_beam;
    const auto heading = portable::sincos(pose.phi + mount.yaw);
    reading = {.from = portable::compose(pose, mrpt::math::TPoint2D(mount.x, mount.y)),
               .direction = {heading.cos, heading.sin},
               .range_m = echoes[i].range_m,
               .hit = isEcho(sensor, echoes[i]),
               .is_new = true};
  }
}

void SonarRegions::correct(const mrpt::math::TPose2D& before, const mrpt::math::TPose2D& now) {
  const auto turn = portable::sincos(now.phi - before.phi);
  for (auto& reading : readings_) {
    reading.from = portable::compose(now, portable::compose(portable::inverse(before), reading.from));
    const auto& d = reading.direction;
    reading.direction = {turn.cos * d.x - turn.sin * d.y, turn.sin * d.x + turn.cos * d.y};
  }
}

void SonarRegions::interpret(const SensorInfo&, const mrpt::math::TPose2D& pose, std::vector<SurfacePoint>& surfaces) {
  rays_.clear();
  const mrpt::math::TPoint2D center(pose.x, pose.y);
  const auto distance = [&](const Reading& r) { return dot(r.from + r.direction * r.range_m - center, r.direction); };
  const auto counts = [&](const Reading& r) { return r.hit && r.age <= kAgeMax; };
  const auto isSame = [&](const Reading& a, const Reading& b) {
    if (!counts(a) || !counts(b) || dot(a.direction, b.direction) < kAdjacentCos) return false;
    return std::abs(distance(a) - distance(b)) < kSame_m + kSamePerM * a.range_m;
  };
  const std::size_t n = by_bearing_.size();
  const auto at = [&](std::size_t k) -> Reading& { return readings_[by_bearing_[k % n]]; };
  std::size_t first = 0;
  while (first < n && isSame(at(first + n - 1), at(first))) ++first;  // a region does not begin within another
  regions_.clear();
  for (std::size_t k = first; k < first + n;) {
    std::size_t end = k + 1;
    while (end < first + n && isSame(at(end - 1), at(end)) && dot(at(k).direction, at(end).direction) > kRegionCos) {
      ++end;
    }
    Region region;
    region.distance_m = distance(at(k));
    region.sonars = end - k;
    for (std::size_t i = k; i < end; ++i) {
      region.is_new |= at(i).is_new;
      region.distance_m = std::min(region.distance_m, distance(at(i)));
      region.direction += at(i).direction;
    }
    region.direction *= 1 / std::sqrt(dot(region.direction, region.direction));
    if (counts(at(k))) regions_.push_back(region);
    k = end;
  }
  for (const Reading& r : readings_) {
    if (!r.is_new || (r.hit && r.range_m < kBlind_m)) continue;
    // A surface that is hit at a flat angle returns no echo, or by way of another one: the ray ends at the lines of all
    // surfaces that others see.
    double open_m = std::min(kOpenMax_m, kOpen * r.range_m);
    for (const Region& region : regions_) {
      const double towards = dot(r.direction, region.direction);
      if (towards < kBesideCos) continue;
      const double clear = region.distance_m - dot(r.from - center, region.direction);
      open_m = std::min(open_m, kOpen * clear / towards);
    }
    if (open_m > 0) rays_.push_back({r.from, r.from + r.direction * open_m, false, false});
  }
  const mrpt::math::TPose2D robot_from_start = portable::inverse(pose);
  const auto turn = portable::sincos(robot_from_start.phi);
  for (const Region& region : regions_) {
    if (!region.is_new) continue;
    const auto& d = region.direction;
    const mrpt::math::TPoint2D foot = center + d * region.distance_m;
    rays_.push_back({foot - d * 0.01, foot, true, region.sonars >= 2});
    if (region.sonars < 2 || region.distance_m > kReach_m) continue;
    surfaces.push_back({portable::compose(robot_from_start, foot),
                        {-turn.cos * d.x + turn.sin * d.y, -turn.sin * d.x - turn.cos * d.y},
                        kRegionStd_m});
  }
  for (auto& reading : readings_) reading.is_new = false;
}

}  // namespace robosim
