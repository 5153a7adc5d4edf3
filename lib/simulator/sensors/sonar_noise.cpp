#include "sensors/sonar_noise.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "sensors/noise_set.h"

namespace robosim {
namespace {

enum class SonarNoiseSet { none, polaroid };

/// Polaroid 6500 ranging module with the 600 series transducer, as on Pioneer and Scout: ±1 % of the range (data
/// sheet).
constexpr RangeNoise kSonarDataSheet{.on = true, .std_m = 0, .std_per_m = 0.01, .dropout = 0};
/// A flat wall is detected up to 42° from the axis (Cao & Borenstein, see SonarLobe): its nearest point in a beam of
/// 26°, the transducer's main lobe, then has an angle of incidence of 42° - 13°.
constexpr double kSpecular_deg = 29;

/// Blanking: the module's minimum of 6 inches. Rates of lost echoes, ringing and crosstalk are assumptions.
SonarNoise polaroid() {
  SonarNoise noise;
  noise.range = {.on = true, .std_m = 0, .std_per_m = 0.01, .dropout = 0.01};
  noise.lobe = SonarLobe::polaroid();
  noise.has_second_echoes = true;
  noise.blanking_m = 0.15;
  noise.ringing = 0.001;
  noise.crosstalk = 0.01;
  noise.robot_crosstalk = 0.02;
  return noise;
}

}  // namespace

SonarLobe SonarLobe::polaroid() {
  // Far: the first zero of a piston of 38 mm at 49.4 kHz, sin θ = 1.22 · 6.95 mm / 38 mm, is at 12.9°.
  return {.on = true, .wall_rad = 42 * kRadPerDeg, .far_rad = 12.9 * kRadPerDeg, .range_m = 5, .edge_share = 0.5};
}

void SonarLobe::read(XmlReader& noise) {
  const bool is_given = noise.has("wall_deg");
  wall_rad = noise.angle("wall_deg", {0, 90}, wall_rad);
  far_rad = noise.angle("far_deg", {0, 90}, is_given && !on ? wall_rad : far_rad);
  range_m = noise.number("lobe_range_m", Bounds::positive(100), range_m);
  edge_share = noise.number("edge_share", Bounds::notNegative(1), edge_share);
  on = on || is_given;
}

double SonarLobe::angleAt(double target_m, SonarTarget target) const {
  const double wall = wall_rad + (far_rad - wall_rad) * std::min(1.0, target_m / range_m);
  return target == SonarTarget::face ? wall : wall * edge_share;
}

SonarNoise SonarNoise::read(XmlReader& sonar, double range_max_m) {
  const auto set = readNoiseSet<SonarNoiseSet>(sonar, {{"polaroid", SonarNoiseSet::polaroid}}, SonarNoiseSet::none);
  SonarNoise noise = set == SonarNoiseSet::polaroid ? polaroid() : SonarNoise();
  noise.blanking_m = std::min(noise.blanking_m, range_max_m);
  auto element = sonar.child("noise");
  if (!element) return noise;
  noise.range = RangeNoise::read(*element, noise.range.on ? noise.range : kSonarDataSheet);
  noise.specular_rad = element->angle("specular_deg", {0, 180}, kSpecular_deg * kRadPerDeg);
  // A given angle of incidence replaces the lobe of the set, unless the lobe is given as well.
  if (element->has("specular_deg")) noise.lobe.on = false;
  noise.lobe.read(*element);
  noise.has_second_echoes = element->flag("second_echoes", noise.has_second_echoes);
  noise.blanking_m = element->number("blanking_m", Bounds::notNegative(range_max_m), noise.blanking_m);
  noise.ringing = element->number("ringing", Bounds::notNegative(1), noise.ringing);
  noise.crosstalk = element->number("crosstalk", Bounds::notNegative(1), noise.crosstalk);
  noise.robot_crosstalk = element->number("robot_crosstalk", Bounds::notNegative(1), noise.robot_crosstalk);
  element->finish();
  return noise;
}

}  // namespace robosim
