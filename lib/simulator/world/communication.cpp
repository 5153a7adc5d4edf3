#include "world/communication.h"

namespace robosim {
namespace {

/// Maximum of the mean durations of bursts of losses and of the times between them: the state of a channel is searched
/// back over about as many steps, for each message.
constexpr double kBurstMax_s = 3600;

}  // namespace

Communication readCommunication(XmlReader& reader, double unit_m) {
  Communication c;
  if (reader.has("range")) c.range_m = reader.length("range", Bounds::positive(), unit_m);
  c.loss_probability = reader.number("loss", {0, 1}, 0);
  if (reader.has("wall_range")) c.wall_range_m = reader.length("wall_range", Bounds::notNegative(), unit_m);
  if (reader.has("wall_range") && !c.range_m) {
    reader.errorAt("wall_range", "shortens the range, and there is none; add <range>");
  }
  c.wall_loss = reader.number("wall_loss", {0, 1}, c.wall_loss);
  c.burst_gap_s = reader.number("burst_gap_s", Bounds::notNegative(kBurstMax_s), c.burst_gap_s);
  c.burst_s = reader.number("burst_s", Bounds::positive(kBurstMax_s), c.burst_s);
  c.burst_loss = reader.number("burst_loss", {0, 1}, c.burst_loss);
  c.delay_s = reader.number("delay_s", {0, kDelayMax_s}, c.delay_s);
  c.rate_hz = reader.number("rate_hz", {0, 1e6}, c.rate_hz);
  reader.finish();
  return c;
}

void writeCommunication(const Communication& communication, double unit_m, XmlElement& element) {
  const Communication defaults;
  if (communication.range_m) element.add("range", toText(*communication.range_m, unit_m));
  const auto add = [&](const char* name, double value, double otherwise, double unit = 1) {
    if (value != otherwise) element.add(name, toText(value, unit));
  };
  add("loss", communication.loss_probability, defaults.loss_probability);
  add("wall_range", communication.wall_range_m, defaults.wall_range_m, unit_m);
  add("wall_loss", communication.wall_loss, defaults.wall_loss);
  add("burst_gap_s", communication.burst_gap_s, defaults.burst_gap_s);
  add("burst_s", communication.burst_s, defaults.burst_s);
  add("burst_loss", communication.burst_loss, defaults.burst_loss);
  add("delay_s", communication.delay_s, defaults.delay_s);
  add("rate_hz", communication.rate_hz, defaults.rate_hz);
}

}  // namespace robosim
