#include "maze/pushing/low_objects.h"

#include <algorithm>
#include <variant>

#include "base/portable_math.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Difference of the ranges of both scanners beyond which a beam of the lower one has met a low object.
constexpr double kLower_m = 0.05;

struct LowEcho {
  TPoint2D point;  ///< robot frame
  double range_m = 0;
};

const Echoes* scanOf(const Robot& robot, const char* label) {
  const Measurement* measurement = robot.measurement(label);
  return measurement ? std::get_if<Echoes>(measurement) : nullptr;
}

/// Echoes of low objects, the nearest first.
std::vector<LowEcho> lowEchoes(const Robot& robot) {
  std::vector<LowEcho> low;
  const Echoes* lower = scanOf(robot, kLowLaser);
  const Echoes* upper = scanOf(robot, kHighLaser);
  if (!lower || !upper || lower->size() != upper->size()) return low;
  for (std::size_t i = 0; i < lower->size(); ++i) {
    const Echo& echo = (*lower)[i];
    if (echo.range_m + kLower_m < (*upper)[i].range_m) low.push_back({{echo.point_m.x, echo.point_m.y}, echo.range_m});
  }
  std::stable_sort(low.begin(), low.end(), [](const auto& a, const auto& b) { return a.range_m < b.range_m; });
  return low;
}

bool areWithin(const TPoint2D& a, const TPoint2D& b, double distance_m) {
  const TPoint2D apart = a - b;
  return apart.x * apart.x + apart.y * apart.y < distance_m * distance_m;
}

}  // namespace

std::vector<TPoint2D> lowObjects(const Robot& robot, double radius_m) {
  std::vector<TPoint2D> centers;
  auto echoes = lowEchoes(robot);
  while (!echoes.empty()) {
    const LowEcho nearest = echoes.front();
    // The beams that meet the object almost as near are on both sides of its centre.
    TPoint2D direction(0, 0);
    for (const LowEcho& echo : echoes) {
      if (echo.range_m > nearest.range_m + radius_m / 4) break;
      if (areWithin(echo.point, nearest.point, radius_m)) direction += echo.point / echo.range_m;
    }
    const double length = portable::hypot(direction.x, direction.y);
    const TPoint2D center = direction * ((nearest.range_m + radius_m) / length);
    centers.push_back(center);
    std::erase_if(echoes, [&](const LowEcho& echo) {
      return areWithin(echo.point, center, 1.25 * radius_m) || areWithin(echo.point, nearest.point, radius_m / 2);
    });
  }
  return centers;
}

}  // namespace robosim
