#include "robots/arcos_parameters_reader.h"

#include <cmath>

namespace robosim {
namespace {

int wholeNumber(XmlReader& reader, const std::string& setting, const Bounds& bounds, int default_value) {
  const double value = reader.number(setting, bounds, default_value);
  if (value != std::floor(value)) reader.errorAt(setting, "must be a whole number");
  return static_cast<int>(value);
}

}  // namespace

arcos::Parameters readArcosParameters(XmlReader& reader) {
  arcos::Parameters p;
  // Largest value of a field of 16 bits.
  const Bounds in_packet = Bounds::positive(65535);
  p.subclass = reader.word("subclass");
  p.distance_unit_mm = reader.number("distance_unit_mm", Bounds::positive(100), p.distance_unit_mm);
  p.turn_radpmm = reader.number("turn_radpmm", Bounds::positive(1), p.turn_radpmm);
  p.wheel_speed_unit_mmps = reader.number("wheel_speed_unit_mmps", Bounds::positive(1000), p.wheel_speed_unit_mmps);
  p.speed_mmps = reader.number("speed_mmps", in_packet, p.speed_mmps);
  p.turn_degps = reader.number("turn_degps", in_packet, p.turn_degps);
  p.accel_mmps2 = reader.number("accel_mmps2", in_packet, p.accel_mmps2);
  p.turn_accel_degps2 = reader.number("turn_accel_degps2", in_packet, p.turn_accel_degps2);
  p.front_bumpers = wholeNumber(reader, "front_bumpers", {0, 7}, p.front_bumpers);
  p.rear_bumpers = wholeNumber(reader, "rear_bumpers", {0, 7}, p.rear_bumpers);
  p.has_front_sonar = reader.flag("has_front_sonar", p.has_front_sonar);
  p.has_rear_sonar = reader.flag("has_rear_sonar", p.has_rear_sonar);
  p.encoder_ticks_per_mm = reader.number("encoder_ticks_per_mm", in_packet, p.encoder_ticks_per_mm);
  p.battery_volts = reader.number("battery_volts", Bounds::positive(100), p.battery_volts);
  p.low_battery_volts = reader.number("low_battery_volts", Bounds::notNegative(100), p.low_battery_volts);
  reader.finish();
  return p;
}

}  // namespace robosim
