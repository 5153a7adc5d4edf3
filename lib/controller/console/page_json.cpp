#include "console/page_json.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "console/team_events.h"
#include "hardware/measurement_fields.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double unit) { return std::round(value / unit) * unit; }
/// Rounded to a tenth of a millimetre or of a milliradian, which is below the resolution of screens.
double fine(double value) { return std::round(value * 1e4) / 1e4; }

std::string textOf(const Json& message) {
  return message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

const char* nameOf(Activity activity) {
  switch (activity) {
    case Activity::active:
      return "active";
    case Activity::halted:
      return "halted";
    case Activity::found:
      return "found";
    case Activity::absent:
      return "absent";
  }
  return "";
}

const char* nameOf(RunView::Phase phase) {
  switch (phase) {
    case RunView::Phase::unknown:
      return "unknown";
    case RunView::Phase::gone:
      return "gone";
    case RunView::Phase::waiting:
      return "waiting";
    case RunView::Phase::paused:
      return "paused";
    case RunView::Phase::running:
      return "running";
    case RunView::Phase::ended:
      return "ended";
  }
  return "";
}

const char* nameOf(RecordingView::State state) {
  switch (state) {
    case RecordingView::State::none:
      return "none";
    case RecordingView::State::on:
      return "on";
    case RecordingView::State::off:
      return "off";
  }
  return "";
}

Json toJson(const RecordingView& recording) {
  return {{"state", nameOf(recording.state)},     {"file", recording.file},       {"may_change", recording.may_change},
          {"is_changing", recording.is_changing}, {"problem", recording.problem}, {"failure", recording.failure}};
}

Json toJson(const mrpt::math::TPose2D& pose) { return {fine(pose.x), fine(pose.y), fine(pose.phi)}; }

std::string toHex(std::uint32_t rgb) {
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4) text += "0123456789abcdef"[rgb >> shift & 15];
  return text;
}

std::string toHex(const std::array<float, 3>& color) {
  std::string text = "#";
  for (const float part : color) {
    const auto level = static_cast<unsigned>(std::lround(part * 255));
    text += "0123456789abcdef"[level / 16];
    text += "0123456789abcdef"[level % 16];
  }
  return text;
}

template <typename Number>
Json toJson(Number number) {
  if constexpr (std::is_integral_v<Number>) return number;
  return fine(static_cast<double>(number));
}

/// A measurement as JSON; null for kinds that depend on pictures. A record of one number is that number, a record of
/// several an object with the fields' names and units, and a list of records an array. Of an echo only the range is
/// sent, in whole millimetres: the point follows from the beam.
struct MeasurementJson {
  Json operator()(const Echoes& echoes) const {
    Json ranges_mm = Json::array();
    for (const Echo& echo : echoes) ranges_mm.push_back(std::lround(echo.range_m * 1000.0F));
    return ranges_mm;
  }
  template <typename M>
  Json operator()(const M& measurement) const {
    if constexpr (!kIsReproducible<M>) return nullptr;
    const auto records = Description<M>::records(measurement);
    Json list = Json::array();
    for (std::size_t i = 0; i < records.size(); ++i) list.push_back(kFieldCount<M> == 1 ? Json() : Json::object());
    forNumbers(measurement, [&](const auto& field, auto number, std::size_t index) {
      const std::string name = std::string(field.name) + (*field.unit.suffix ? "_" : "") + field.unit.suffix;
      (kFieldCount<M> == 1 ? list[index] : list[index][name]) = toJson(number);
    });
    return kIsSingle<M> ? list[0] : list;
  }
};

/// Whether an update contains readings of this kind only for subscribers; others request them by REQ_….
bool isOnRequest(SensorKind kind) {
  return kind == SensorKind::sonar || kind == SensorKind::laser || kind == SensorKind::heat ||
         kind == SensorKind::infrared;
}

Json toJson(const SensorInfo& sensor) {
  Json beams = Json::array();
  for (const auto& beam : sensor.beams) {
    const auto& at = beam.robot_from_beam;
    beams.push_back({fine(at.x), fine(at.y), fine(at.yaw)});
  }
  Json out{{"kind", nameOf(sensor.kind)},
           {"label", sensor.label},
           {"beams", beams},
           {"range_max_m", sensor.range_max_m},
           {"no_echo_mm", std::lround(static_cast<float>(sensor.no_echo_m) * 1000.0F)},
           {"beam_width_rad", fine(sensor.beam_width_rad)},
           {"pans", sensor.pans}};
  if (sensor.kind == SensorKind::camera) {
    out["width_px"] = sensor.camera.width_px;
    out["height_px"] = sensor.camera.height_px;
  }
  return out;
}

const char* nameOf(v1::Activity activity) { return nameOf(*decode(activity)); }

std::optional<double> readDriven(const v1::RobotState& state) {
  return state.has_driven_m() ? std::optional(state.driven_m()) : std::nullopt;
}

Json numberOrNull(const std::optional<double>& number) { return number ? Json(fine(*number)) : Json(nullptr); }

Json toJson(const v1::RobotState& state) {
  return {{"autonomous", state.autonomous()},       {"driver", state.driver()},
          {"is_yours", state.is_yours()},           {"speed_mps", fine(state.speed_mps())},
          {"turn_radps", fine(state.turn_radps())}, {"activity", nameOf(state.activity())},
          {"why_stopped", state.why_stopped()},     {"win_refusals", state.win_refusals()},
          {"is_stopping", state.is_stopping()},     {"stops", state.stops()}};
}

/// The newest heat reading: of the primary, in its update; of the others, in the answer to a request.
std::optional<double> heatOf(const RobotNews& news) {
  const auto& answer = news.answers[0];
  if (news.update && (!answer || answer->step < news.update->readings.time.step)) {
    const auto& sensors = *news.info->sensors;
    const auto found = std::find_if(sensors.begin(), sensors.end(),
                                    [](const SensorInfo& sensor) { return sensor.kind == SensorKind::heat; });
    if (found == sensors.end()) return std::nullopt;
    const auto& measured = news.update->readings.measurements[static_cast<std::size_t>(found - sensors.begin())];
    const auto* scalar = std::get_if<Scalar>(&measured);
    return scalar ? std::optional<double>(scalar->value) : std::nullopt;
  }
  const auto* scalar = answer && answer->has_sensor ? std::get_if<Scalar>(&answer->measurement) : nullptr;
  return scalar ? std::optional<double>(scalar->value) : std::nullopt;
}

/// Index and place of each object that is elsewhere than the page shows it.
Json movedObjects(const MapView& map, const MapView* sent) {
  Json moved = Json::array();
  const auto* shown = sent && sent->world == map.world ? sent->world_from_object.get() : nullptr;
  if (!map.world || map.world_from_object.get() == shown) return moved;
  const auto& objects = map.world->objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& now = map.world_from_object ? (*map.world_from_object)[i] : objects[i].world_from_object;
    const auto& before = shown ? (*shown)[i] : objects[i].world_from_object;
    if (now != before) moved.push_back({i, fine(now.x), fine(now.y), fine(now.phi)});
  }
  return moved;
}

}  // namespace

std::string welcomeJson(std::uint64_t page, bool may_operate, bool has_rounds) {
  return textOf({{"type", "welcome"}, {"you", page}, {"may_operate", may_operate}, {"has_rounds", has_rounds}});
}

std::string pongJson(std::uint64_t number) { return textOf({{"type", "pong"}, {"number", number}}); }

std::string refusedJson(const std::string& text) { return textOf({{"type", "refused"}, {"text", text}}); }

std::string robotJson(const RobotInfo& robot, double period_s) {
  Json sensors = Json::array();
  for (const auto& sensor : *robot.sensors) sensors.push_back(toJson(sensor));
  return textOf({{"type", "robot"},
                 {"name", robot.name},
                 {"model", robot.type->model},
                 {"radius_m", robot.radius_m},
                 {"speed_max_mps", robot.type->limits.speed_max_mps},
                 {"turn_max_radps", robot.type->limits.turn_max_radps},
                 {"period_s", period_s},
                 {"sensors", sensors}});
}

std::string teamJson(const std::vector<TeamRobot>& robots, const ControlLock& lock) {
  Json team = Json::array();
  std::string world;
  const std::string winner = winnerOf(robots);
  std::optional<double> winner_driven_m;
  for (const auto& robot : robots) {
    const RobotNews& news = robot.news;
    team.push_back({{"name", robot.name},
                    {"address", robot.address},
                    {"model", news.info ? news.info->type->model : ""},
                    {"up", news.is_up},
                    {"over", news.is_over},
                    {"problem", news.problem},
                    {"fit", robot.isFit()},
                    {"autonomous", news.state.autonomous()},
                    {"driver", news.state.driver()},
                    {"is_yours", news.state.is_yours()},
                    {"activity", nameOf(news.state.activity())},
                    {"is_stopping", news.state.is_stopping()},
                    {"why_stopped", news.state.why_stopped()},
                    {"color", news.info && news.info->color_rgb ? toHex(*news.info->color_rgb) : ""}});
    if (news.state.winner() == robot.name) winner_driven_m = readDriven(news.state);
    if (!news.world.empty()) world = news.world;
  }
  return textOf({{"type", "team"},
                 {"world", world},
                 {"robots", team},
                 {"control_lock", {{"holder", lock.holder}, {"name", lock.name}}},
                 {"pages", lock.pages},
                 {"winner", winner},
                 {"winner_driven_m", winner.empty() ? Json(nullptr) : numberOrNull(winner_driven_m)}});
}

std::string vitalsJson(const std::vector<TeamRobot>& robots) {
  Json vitals = Json::object();
  for (const auto& robot : robots) {
    if (!robot.news.is_up) continue;
    const auto heat = heatOf(robot.news);
    vitals[robot.name] = {{"heat", heat ? Json(std::round(*heat * 10) / 10) : Json(nullptr)},
                          {"stalled", robot.news.state.stalled()}};
  }
  return textOf({{"type", "vitals"}, {"robots", vitals}});
}

std::string updateJson(const RobotInfo& robot, const RobotUpdate& update, const RobotPicture* picture,
                       bool with_sensors) {
  Json measurements = Json::array();
  for (std::size_t i = 0; i < update.readings.measurements.size(); ++i) {
    const bool is_left_out = !with_sensors && isOnRequest((*robot.sensors)[i].kind);
    measurements.push_back(is_left_out ? Json(nullptr)
                                       : std::visit(MeasurementJson{}, update.readings.measurements[i]));
  }
  const Readings& readings = update.readings;
  Json message{{"type", "update"},
               {"robot", robot.name},
               {"step", readings.time.step},
               {"time_s", rounded(readings.time.seconds(), 1e-3)},
               {"stalled", readings.stalled},
               {"driven_m", numberOrNull(readDriven(update.state))},
               {"laser_pan_rad", fine(readings.laser_pan_rad)},
               {"state", toJson(update.state)},
               {"measurements", measurements}};
  if (picture) message["picture_step"] = picture->step;
  return textOf(message);
}

std::string answerJson(const char* sensor, const RobotAnswer& answer) {
  Json message{{"type", "answer"}, {"sensor", sensor}, {"step", answer.step}, {"slot", nullptr}};
  if (answer.has_sensor) {
    message["slot"] = answer.sensor;
    message["measurement"] = std::visit(MeasurementJson{}, answer.measurement);
  }
  return textOf(message);
}

std::string runJson(const RunView& run) {
  return textOf({{"type", "run"},
                 {"phase", nameOf(run.phase)},
                 {"problem", run.problem},
                 {"absent", run.absent},
                 {"may_restart", run.may_restart},
                 {"is_restarting", run.is_restarting},
                 {"recording", toJson(run.recording)}});
}

std::string pulseJson() { return textOf({{"type", "pulse"}}); }

std::string mapJson(const MapView& map) {
  if (!map.world) return textOf({{"type", "map"}, {"problem", map.problem}});
  const MapWorld& world = *map.world;
  Json objects = Json::array();
  for (const auto& object : world.objects) {
    objects.push_back({{"at", toJson(object.world_from_object)},
                       {"length_m", object.length_m},
                       {"width_m", object.width_m},
                       {"radius_m", object.radius_m},
                       {"color", toHex(object.color)},
                       {"hot", object.is_hot}});
  }
  Json robots = Json::array();
  for (const auto& robot : world.robots) {
    robots.push_back({{"name", robot.name}, {"radius_m", robot.radius_m}, {"color", toHex(robot.color)}});
  }
  return textOf({{"type", "map"},
                 {"name", world.name},
                 {"x_m", {world.x_min_m, world.x_max_m}},
                 {"y_m", {world.y_min_m, world.y_max_m}},
                 {"objects", objects},
                 {"robots", robots}});
}

std::string posesJson(const MapView& map, const MapView* sent) {
  Json robots = Json::array();
  for (std::size_t i = 0; i < map.world_from_robot.size(); ++i) {
    robots.push_back({{"at", toJson(map.world_from_robot[i])}, {"activity", nameOf(map.activity[i])}});
  }
  Json poses = {{"type", "poses"}, {"step", map.step}, {"robots", robots}};
  if (Json moved = movedObjects(map, sent); !moved.empty()) poses["objects"] = std::move(moved);
  return textOf(poses);
}

std::string noteJson(const std::string& text, bool is_warning, const std::string& detail) {
  return textOf({{"type", "note"}, {"text", text}, {"warning", is_warning}, {"detail", detail}});
}

}  // namespace robosim
