#include "replay/selection.h"

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/text_table.h"

namespace robosim {
namespace {

/// "a, b, c"; of a long list only the first names.
std::string inWords(const std::set<std::string>& names) {
  constexpr std::size_t kMaxNames = 20;
  std::string text;
  std::size_t count = 0;
  for (const auto& name : names) {
    if (name.empty()) continue;
    if (++count > kMaxNames) return text + ", …";
    text += (text.empty() ? "" : ", ") + printableText(name);
  }
  return text.empty() ? "none with a name" : text;
}

}  // namespace

bool ReplayArguments::selects(const std::string& robot, const std::string& sensor) const {
  const auto holds = [](const std::vector<std::string>& list, const std::string& what) {
    return list.empty() || std::find(list.begin(), list.end(), what) != list.end();
  };
  return holds(robots, robot) && holds(sensors, sensor);
}

void warnOf(const RawlogReader& reader) {
  for (const auto& assumption : reader.assumptions()) logWarning("replay", assumption);
  if (reader.readError()) logWarning("replay", *reader.readError());
}

void failInterrupted(double read_s) {
  throw Interrupted("interrupted; only the first " + fixed(read_s, 1) + " s of the recording were read");
}

bool Selection::takes(const mrpt::obs::CObservation& observation, const RawlogReader& reader) {
  const auto [known, is_new] = selects_.try_emplace(observation.sensorLabel);
  if (is_new) {
    const Label label = Label::parse(observation.sensorLabel);
    const std::string sensor = label.withinRobot();
    robots_.insert(label.robot);
    sensors_.insert(sensor);
    known->second = arguments_.selects(label.robot, sensor);
  }
  time_s_ = times_.of(observation, reader.entries());
  is_empty_ = false;
  earliest_s_ = std::min(earliest_s_, time_s_);
  latest_s_ = std::max(latest_s_, time_s_);
  const bool takes = known->second && !(arguments_.from_s && time_s_ < *arguments_.from_s) &&
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
  throw ConfigError("no observation matches --robot, --sensor, --from and --to; the recording spans " +
                    fixed(earliest_s_, 1) + " s to " + fixed(latest_s_, 1) + " s");
}

}  // namespace robosim
