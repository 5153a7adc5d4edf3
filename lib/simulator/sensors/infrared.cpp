#include "sensors/infrared.h"

#include <algorithm>

#include "sensors/beam_mounts.h"
#include "sensors/noise_set.h"
#include "sensors/thin_beams.h"

namespace robosim {
namespace {

/// GP2D12 behind an 8-bit converter: one step is about 2 % of the range in the middle of its curve (data sheet).
constexpr RangeNoise kInfraredDataSheet{.on = true, .std_m = 0, .std_per_m = 0.02, .dropout = 0};

enum class InfraredSet { none, gp2d12 };

}  // namespace

InfraredOptions InfraredOptions::read(XmlReader& reader) {
  InfraredOptions o;
  o.label = reader.word("label", o.label);
  o.beams = readBeamMounts(reader);
  o.range_max_m = reader.number("range_max_m", Bounds::positive(10), o.range_max_m);
  o.range_min_m =
      reader.number("range_min_m", Bounds::notNegative(o.range_max_m), std::min(o.range_min_m, o.range_max_m / 8));
  const auto set = readNoiseSet<InfraredSet>(reader, {{"gp2d12", InfraredSet::gp2d12}}, InfraredSet::none);
  if (set == InfraredSet::gp2d12) o.curve = InfraredCurve::gp2d12();
  if (auto element = reader.child("noise")) {
    // The curve takes the place of the data sheet's error in the middle of its range.
    o.noise = RangeNoise::read(*element, o.curve.on ? RangeNoise() : kInfraredDataSheet);
    o.curve.read(*element);
    element->finish();
  }
  return o;
}

std::unique_ptr<Sensor> makeInfrared(const InfraredOptions& o) {
  auto sensor = makeThinBeams({.kind = SensorKind::infrared,
                               .label = o.label,
                               .beams = o.beams,
                               .range_min_m = o.curve.on ? 0 : o.range_min_m,
                               .range_max_m = o.range_max_m,
                               .no_echo_m = o.range_max_m,
                               .beam_width_rad = 0,
                               .noise_std_m = o.noise.stdAt(o.range_max_m),
                               .pans = false},
                              o.noise);
  return o.curve.on ? withInfraredCurve(std::move(sensor), o.curve, o.range_min_m) : std::move(sensor);
}

}  // namespace robosim
