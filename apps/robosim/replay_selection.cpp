#include "robosim/replay_selection.h"

#include "base/error_list.h"
#include "robosim/text.h"

namespace robosim {
namespace {

/// "a, b, c"; of many the first ones.
std::string inWords(const std::set<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  std::size_t count = 0;
  for (const auto& name : names) {
    if (name.empty()) continue;
    if (++count > kMost) return text + ", …";
    text += (text.empty() ? "" : ", ") + printable(name);
  }
  return text.empty() ? "none with a name" : text;
}

}  // namespace

bool Selection::takes(const mrpt::obs::CObservation& observation, const RawlogReader& reader) {
  const LabelParts parts = partsOf(observation.sensorLabel);
  time_s_ = times_.of(observation, reader.entries());
  is_empty_ = false;
  earliest_s_ = std::min(earliest_s_, time_s_);
  latest_s_ = std::max(latest_s_, time_s_);
  robots_.insert(parts.robot);
  sensors_.insert(parts.sensor);
  const bool takes = arguments_.wants(parts.robot, parts.sensor) &&
                     !(arguments_.from_s && time_s_ < *arguments_.from_s) &&
                     !(arguments_.to_s && time_s_ > *arguments_.to_s);
  has_found_ = has_found_ || takes;
  return takes;
}

void Selection::checkFound() const {
  if (has_found_ || is_empty_) return;
  for (const auto& robot : arguments_.robots) {
    if (robots_.count(robot) == 0) {
      throw ConfigError("no observation is of robot " + robot + "; there are " + inWords(robots_));
    }
  }
  for (const auto& sensor : arguments_.sensors) {
    if (sensors_.count(sensor) == 0) {
      throw ConfigError("no observation is of sensor " + sensor + "; there are " + inWords(sensors_));
    }
  }
  throw ConfigError("no observation is what --robot, --sensor, --from and --to ask for; the recording goes from " +
                    fixed(earliest_s_, 1) + " s to " + fixed(latest_s_, 1) + " s");
}

}  // namespace robosim
