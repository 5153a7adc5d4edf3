#include "sensors/laser.h"

#include <cmath>

#include "sensors/beam_mounts.h"
#include "sensors/laser_types.h"
#include "sensors/position_2005.h"
#include "sensors/thin_beams.h"

namespace robosim {
namespace {

/// SICK LMS 200, ranges up to 8 m: statistical error 5 mm, one standard deviation (Technical Description
/// LMS200/211/221).
constexpr double kStd_m = 0.005;

/// Reads the attribute noise="…", a type of scanner, and the child <noise>, whose settings replace those of the type,
/// or of the data sheet.
void readNoise(XmlReader& reader, LaserOptions& o) {
  const std::string name = reader.attribute("noise", kLaserTypeNames);
  const LaserType* const type = laserTypeNamed(name);
  if (type) {
    o.errors = type->errors;
    o.timing.sweep_s = type->sweep_s;
  } else if (!name.empty()) {
    reader.errorAt("noise", std::string("is not a type of scanner; accepted are: ") + kLaserTypeNames);
  }
  auto element = reader.child("noise");
  if (!element) return;
  LaserErrors data_sheet;
  data_sheet.std_m = kStd_m;
  o.errors = LaserErrors::read(*element, type ? type->errors : data_sheet);
  element->finish();
}

}  // namespace

LaserOptions LaserOptions::read(XmlReader& reader) {
  LaserOptions o;
  o.label = reader.word("label", o.label);
  o.robot_from_laser = readPosition(reader);
  o.direction_rad = reader.angle("angle_deg", {-360, 360}, 0);
  const double beams = reader.number("beams", {1, 10000}, o.beams);
  if (beams != std::floor(beams)) reader.errorAt("beams", "must be a whole number");
  o.beams = static_cast<int>(beams);
  o.field_of_view_rad = reader.angle("field_of_view_deg", Bounds::positive(360), o.field_of_view_rad);
  o.range_max_m = reader.number("range_max_m", Bounds::positive(1000), o.range_max_m);
  o.range_min_m = reader.number("range_min_m", Bounds::notNegative(o.range_max_m), 0);
  o.no_return_m = reader.number("no_return_m", {o.range_max_m, 10000}, o.range_max_m);
  o.pans = reader.flag("pans", false);
  readNoise(reader, o);
  o.timing.read(reader);
  o.timing.interlace_s = reader.number("interlace_s", Bounds::notNegative(10), 0);
  return o;
}

LaserOptions LaserOptions::read2005(XmlReader& reader, const Mount& mount) {
  const Position2005 position = Position2005::read(reader, mount);
  LaserOptions o;
  o.robot_from_laser = {position.x_m, position.y_m, position.z_m};
  o.direction_rad = position.direction_rad;
  o.beams = 1;
  o.range_max_m = position.range_m;
  o.no_return_m = position.range_m + mount.unit_m;
  o.pans = true;
  readNoise(reader, o);
  return o;
}

std::unique_ptr<Sensor> makeLaser(const LaserOptions& o) {
  SensorInfo info{.kind = SensorKind::laser,
                  .label = o.label,
                  .beams = {},
                  .range_min_m = o.range_min_m,
                  .range_max_m = o.range_max_m,
                  .no_echo_m = o.no_return_m,
                  .beam_width_rad = 0,
                  .noise_std_m = o.errors.largestStd(o.range_max_m),
                  .pans = o.pans};
  for (int i = 0; i < o.beams; ++i) {
    const double off_middle = o.beams == 1 ? 0 : o.field_of_view_rad * (static_cast<double>(i) / (o.beams - 1) - 0.5);
    info.beams.push_back(
        planarBeam(o.robot_from_laser.x, o.robot_from_laser.y, o.robot_from_laser.z, o.direction_rad + off_middle));
  }
  const bool is_exact = o.errors == LaserErrors() && o.timing == LaserTiming();
  return is_exact ? makeThinBeams(info, {}) : makeLaserScanner(info, o.errors, o.timing);
}

}  // namespace robosim
