#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "sensors/beam_mounts.h"
#include "sensors/position_2005.h"
#include "sensors/sonar.h"

namespace robosim {
namespace {

SonarModel readModel(XmlReader& reader, SonarModel otherwise) {
  return reader.choice<SonarModel>("model", {{"sector", SonarModel::sector}, {"rays", SonarModel::rays}}, otherwise);
}

int readRays(XmlReader& reader, int otherwise) {
  const double rays = reader.number("rays", {1, 1000}, otherwise);
  if (rays != std::floor(rays)) reader.errorAt("rays", "must be a whole number");
  return static_cast<int>(rays);
}

}  // namespace

SonarOptions SonarOptions::read(XmlReader& reader) {
  SonarOptions o;
  o.label = reader.word("label", o.label);
  o.model = readModel(reader, o.model);
  o.rays = readRays(reader, o.rays);
  o.beams = readBeamMounts(reader);
  o.range_max_m = reader.number("range_max_m", Bounds::positive(100), o.range_max_m);
  o.range_min_m = reader.number("range_min_m", Bounds::notNegative(o.range_max_m), 0);
  o.no_echo_m = reader.number("no_echo_m", {o.range_max_m, 1000}, o.range_max_m);
  o.beam_width_rad = reader.angle("beam_width_deg", Bounds::positive(120), o.beam_width_rad);
  o.firing = SonarFiring::read(reader);
  o.noise = SonarNoise::read(reader, o.range_max_m);
  return o;
}

SonarOptions SonarOptions::read2005(XmlReader& reader, const Mount& mount) {
  SonarOptions o;
  const Position2005 position = Position2005::read(reader, mount);
  o.model = readModel(reader, o.model);
  o.rays = readRays(reader, o.rays);
  o.range_max_m = position.range_m;
  o.no_echo_m = position.range_m + mount.unit_m;
  const double mode = reader.number("mode", {1, 2}, 2);
  if (mode != 1 && mode != 2) reader.errorAt("mode", "must be 1 (8 sonars in front) or 2 (16 all round)");
  // In the table the four sonars that face straight sideways are mounted 0.5 before or behind the centre of a robot of
  // radius 3.
  const double aside_m = mount.robot_radius_m / 6;
  const double bearings_deg[] = {-90, -50, -30, -10, 10, 30, 50, 90, 90, 130, 150, 170, -170, -150, -130, -90};
  for (int i = 0; i < (mode == 1 ? 8 : 16); ++i) {
    const double angle = bearings_deg[i] * kRadPerDeg;
    const bool faces_sideways = std::abs(bearings_deg[i]) == 90;
    const auto [sin, cos] = portable::sincos(angle);
    const double x_m = faces_sideways ? (i < 8 ? aside_m : -aside_m) : mount.robot_radius_m * cos;
    o.beams.push_back(planarBeam(x_m, mount.robot_radius_m * sin, position.z_m, angle));
  }
  o.noise = SonarNoise::read(reader, o.range_max_m);
  return o;
}

std::size_t SonarOptions::rayCount() const {
  return beams.size() * (model == SonarModel::rays ? static_cast<std::size_t>(rays) : 1);
}

}  // namespace robosim
