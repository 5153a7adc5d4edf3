#include "live_page/live_encoding.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>
#include <variant>

#include "hardware/measurement_fields.h"
#include "run_page/page_world.h"

namespace robosim {
namespace {

using nlohmann::ordered_json;

constexpr const char* kPan = "STATUS";  ///< the sensor of recordings that has the angle of panning sensors

void append(std::string& text, std::int64_t number) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

/// In 6 digits; null if it is not finite.
void append(std::string& text, double number) {
  if (!std::isfinite(number)) {
    text += "null";
    return;
  }
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 6).ptr;
  text.append(digits.data(), end);
}

std::int64_t inUnits(double value, double unit) {
  constexpr double kMost = 1e15;  // exact in JavaScript
  return std::isfinite(value) ? std::llround(std::clamp(value / unit, -kMost, kMost)) : 0;
}

void append(std::string& text, const mrpt::math::TPose2D& pose) {
  append(text, inUnits(pose.x, LiveEncoding::kPlace_m));
  text += ',';
  append(text, inUnits(pose.y, LiveEncoding::kPlace_m));
  text += ',';
  append(text, inUnits(pose.phi, LiveEncoding::kHeading_rad));
}

/// Whether a page receives a number of a measurement: of echoes the range, whose point follows from it.
template <typename M, typename FieldOf>
bool isShown(const FieldOf& field) {
  return !std::is_same_v<M, Echoes> || std::string_view(field.name) == "range";
}

/// Calls visit(name, number) for the numbers of a measurement that a page receives; the names are those of the columns
/// of an export.
template <typename Visit>
void forShownNumbers(const Measurement& measurement, const Visit& visit) {
  std::visit(
      [&](const auto& of_kind) {
        using M = std::decay_t<decltype(of_kind)>;
        if constexpr (!kIsFile<M>) {
          const bool is_present = isPresent(of_kind);
          forNumbers(of_kind, [&](const auto& field, const auto& number, std::size_t index) {
            if (!isShown<M>(field)) return;
            const auto name = [&, index] {
              std::string text = field.name;
              if (!kIsSingle<M>) text += '_' + std::to_string(index);
              return *field.unit.suffix ? text + '_' + field.unit.suffix : text;
            };
            visit(name, is_present ? static_cast<double>(number) : std::nan(""));
          });
        }
      },
      measurement);
}

std::vector<std::string> columnsOf(const SensorInfo& sensor) {
  std::vector<std::string> columns;
  forShownNumbers(blankMeasurement(sensor), [&](const auto& name, double) { columns.push_back(name()); });
  return columns;
}

}  // namespace

LiveEncoding::LiveEncoding(std::string id, std::string title, const World& world, const Fleet& fleet,
                           std::vector<std::pair<std::string, std::string>> facts)
    : id_(std::move(id)),
      title_(std::move(title)),
      of_world_(world.objects),
      world_(textOf(pageWorld(world))),
      facts_(std::move(facts)) {
  for (const auto& robot : fleet.robots) addRobot(robot);
  had_readings_ = hasReadings();
}

void LiveEncoding::addRobot(const FleetRobot& robot) {
  robots_.push_back(pageRobot(robot, types_));
  auto& own = sensors_of_robot_.emplace_back();
  if (!robot.info.sensors) return;
  for (const auto& sensor : *robot.info.sensors) {
    const auto columns = columnsOf(sensor);
    readings_ += columns.size();
    own.push_back(sensorNamed(sensor.label, columns));
    if (sensor.pans && !status_) status_ = sensorNamed(kPan, {"pan_rad"});
  }
}

/// Sensors of the same name have the columns of all.
std::size_t LiveEncoding::sensorNamed(const std::string& name, const std::vector<std::string>& columns) {
  std::size_t index = 0;
  while (index < sensors_.size() && sensors_[index].name != name) ++index;
  if (index == sensors_.size()) sensors_.push_back({name, {}});
  auto& known = sensors_[index].columns;
  if (columns.size() > known.size()) known = columns;
  return index;
}

ordered_json LiveEncoding::sensors() const {
  ordered_json sensors = ordered_json::array();
  if (!had_readings_) return sensors;
  for (const auto& sensor : sensors_) sensors.push_back({{"name", sensor.name}, {"columns", sensor.columns}});
  return sensors;
}

ordered_json LiveEncoding::remarks() const {
  ordered_json remarks = ordered_json::array();
  if (hasReadings()) return remarks;
  remarks.push_back(std::string("The page receives no readings of sensors") +
                    (had_readings_ ? " since robots were added" : "") + ": those of all robots have " +
                    std::to_string(readings_) + " numbers in each step, and it receives them up to " +
                    std::to_string(kMaxReadings) + ".");
  return remarks;
}

std::string LiveEncoding::description() const {
  ordered_json facts = ordered_json::array();
  for (const auto& [name, value] : facts_) facts.push_back({name, value});
  std::string text = textOf({{"type", "run"},
                             {"id", id_},
                             {"title", title_},
                             {"types", types_},
                             {"robots", robots_},
                             {"sensors", sensors()},
                             {"facts", std::move(facts)},
                             {"remarks", remarks()}});
  text.pop_back();
  return text + ",\"world\":" + world_ + "}";  // maps are large, and stay the same
}

bool LiveEncoding::canBeOf(const World& world, const Fleet& fleet) const {
  if (fleet.robots.size() < robots_.size() || textOf(pageWorld(world)) != world_) return false;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (robots_[i]["name"] != fleet.robots[i].info.name) return false;
  }
  return true;
}

std::vector<LiveItem> LiveEncoding::addRobots(const Fleet& fleet) {
  const std::size_t before = robots_.size();
  if (fleet.robots.size() <= before) return {};
  for (std::size_t i = before; i < fleet.robots.size(); ++i) addRobot(fleet.robots[i]);
  ordered_json robots = ordered_json::array();
  for (std::size_t i = before; i < robots_.size(); ++i) robots.push_back(robots_[i]);
  return {{textOf({{"k", "a"},
                   {"from", before},
                   {"types", types_},
                   {"robots", std::move(robots)},
                   {"sensors", sensors()},
                   {"remarks", remarks()}}),
           LiveItemKind::robots}};
}

LiveItem LiveEncoding::objectsItem(const LiveMoment& moment) {
  const auto& objects = moment.objects.orThose(of_world_);
  moving_ = movingObjects(objects);
  return {
      textOf(
          {{"k", "o"}, {"t", inUnits(moment.time_s, kTime_s)}, {"objects", pageObjects(objects)}, {"moving", moving_}}),
      LiveItemKind::objects};
}

std::vector<LiveItem> LiveEncoding::add(const LiveMoment& moment) {
  std::vector<LiveItem> items;
  const auto& objects = moment.objects.orThose(of_world_);
  if (!objects_) {
    items.push_back(objectsItem(moment));
  } else if (!moment.objects.isSameList(*objects_)) {
    // An object that a person has moved has no track: it is one of another list.
    const auto moved = movedBetween(objects_->orThose(of_world_), objects);
    const bool has_tracks = moved && std::all_of(moved->begin(), moved->end(), [this](std::uint32_t i) {
                              return std::binary_search(moving_.begin(), moving_.end(), i);
                            });
    if (!has_tracks) items.push_back(objectsItem(moment));
  }
  objects_ = moment.objects;
  std::string text = "{\"k\":\"m\",\"t\":";
  append(text, inUnits(moment.time_s, kTime_s));
  text += ",\"r\":[";
  for (const auto& robot : moment.robots) {
    const PageRobotState& state = robot.state;
    if (text.back() != '[') text += ',';
    append(text, robot.world_from_robot);
    text += ',';
    append(text, std::int64_t{state.flags()});
    text += ',';
    append(text, std::int64_t{state.led_color});
  }
  text += "],\"o\":[";
  for (const std::uint32_t i : moving_) {
    if (text.back() != '[') text += ',';
    append(text, objects[i].body.world_from_body);
  }
  text += ']';
  if (hasReadings()) addReadings(moment, text);
  items.push_back({text + '}', LiveItemKind::moment});
  if (!moment.events.empty()) {
    ordered_json events = ordered_json::array();
    for (std::size_t i = 0; i < std::min(moment.events.size(), kMaxEvents); ++i) {
      const LiveEvent& event = moment.events[i];
      events.push_back({event.kind, event.robot ? ordered_json(*event.robot) : ordered_json(-1), event.text});
    }
    items.push_back({textOf({{"k", "e"}, {"t", inUnits(moment.time_s, kTime_s)}, {"events", std::move(events)}}),
                     LiveItemKind::event});
  }
  return items;
}

void LiveEncoding::addReadings(const LiveMoment& moment, std::string& text) const {
  text += ",\"v\":[";
  for (std::size_t i = 0; i < std::min(moment.robots.size(), sensors_of_robot_.size()); ++i) {
    const Readings* const readings = moment.robots[i].readings;
    if (!readings || moment.robots[i].state.activity == Activity::absent) continue;
    const auto begin = [&](std::size_t sensor) {
      if (text.back() != '[') text += ',';
      text += '[';
      append(text, static_cast<std::int64_t>(i));
      text += ',';
      append(text, static_cast<std::int64_t>(sensor));
    };
    const auto& own = sensors_of_robot_[i];
    for (std::size_t s = 0; s < std::min(own.size(), readings->measurements.size()); ++s) {
      begin(own[s]);
      forShownNumbers(readings->measurements[s], [&](const auto&, double number) {
        text += ',';
        append(text, number);
      });
      text += ']';
    }
    if (status_) {
      begin(*status_);
      text += ',';
      append(text, static_cast<double>(readings->laser_pan_rad));
      text += ']';
    }
  }
  text += ']';
}

}  // namespace robosim
