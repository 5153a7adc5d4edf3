#include "sensors/beam_mounts.h"

#include <cmath>

#include "base/portable_math.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

constexpr int kMaxRingBeams = 1024;

void readRing(XmlReader& ring, std::vector<Beam>& beams) {
  const double count = ring.number("count", {1, kMaxRingBeams});
  const double radius_m = ring.number("radius_m", Bounds::notNegative(100));
  const double z_m = ring.number("z_m", {-100, 100}, 0);
  const double first_rad = ring.angle("first_angle_deg", {-360, 360}, 0);
  if (count != std::floor(count)) ring.errorAt("count", "must be a whole number");
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double angle = first_rad + 2 * M_PI * i / count;
    const auto [sin, cos] = portable::sincos(angle);
    beams.push_back(planarBeam(radius_m * cos, radius_m * sin, z_m, angle));
  }
  ring.finish();
}

void readOne(XmlReader& at, std::vector<Beam>& beams) {
  const auto position = readPosition(at);
  beams.push_back(planarBeam(position.x, position.y, position.z, at.angle("angle_deg", {-360, 360}, 0)));
  at.finish();
}

}  // namespace

std::vector<Beam> readBeamMounts(XmlReader& sensor) {
  std::vector<Beam> beams;
  for (auto& at : sensor.all("at")) readOne(at, beams);
  for (auto& ring : sensor.all("ring")) {
    readRing(ring, beams);
    if (beams.size() > kRobotRaysMax) break;  // the caller rejects the sensor
  }
  if (beams.empty()) sensor.error("has no mounting pose; add <at x_m=\"…\" y_m=\"…\" z_m=\"…\" angle_deg=\"…\"/>");
  return beams;
}

mrpt::math::TPoint3D readPosition(XmlReader& reader, double bound_m) {
  const Bounds bounds{-bound_m, bound_m};
  const double x_m = reader.number("x_m", bounds, 0);
  const double y_m = reader.number("y_m", bounds, 0);
  return {x_m, y_m, reader.number("z_m", bounds, 0)};
}

Beam planarBeam(double x_m, double y_m, double z_m, double angle_rad) {
  return {mrpt::math::TPose3D(x_m, y_m, z_m, std::remainder(angle_rad, 2 * M_PI), 0, 0)};
}

std::map<double, std::vector<std::size_t>> beamsByHeight(const std::vector<Beam>& beams) {
  std::map<double, std::vector<std::size_t>> by_height;
  for (std::size_t i = 0; i < beams.size(); ++i) by_height[originOf(beams[i]).z].push_back(i);
  return by_height;
}

}  // namespace robosim
