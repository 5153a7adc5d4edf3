#include "remote/page_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double unit) { return std::round(value / unit) * unit; }
/// To a tenth of a millimetre, of a milliradian: finer than any screen.
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
  }
  return "";
}

Json jsonOf(const mrpt::math::TPose2D& pose) { return {fine(pose.x), fine(pose.y), fine(pose.phi)}; }

std::string hexOf(const std::array<float, 3>& color) {
  std::string text = "#";
  for (const float part : color) {
    const auto level = static_cast<unsigned>(std::lround(part * 255));
    text += "0123456789abcdef"[level / 16];
    text += "0123456789abcdef"[level % 16];
  }
  return text;
}

struct MeasurementJson {
  Json operator()(const Echoes& echoes) const {
    Json ranges_mm = Json::array();
    for (const Echo& echo : echoes) ranges_mm.push_back(std::lround(echo.range_m * 1000.0F));
    return ranges_mm;
  }
  Json operator()(const Scalar& scalar) const { return fine(scalar.value); }
  Json operator()(const Contacts& contacts) const { return contacts.pressed; }
  Json operator()(const Odometry& odometry) const {
    const auto& pose = odometry.odom_from_robot;
    return {{"x_m", fine(pose.x)},
            {"y_m", fine(pose.y)},
            {"phi_rad", fine(pose.phi)},
            {"speed_mps", fine(odometry.speed_mps)},
            {"turn_radps", fine(odometry.turn_radps)}};
  }
  Json operator()(const Image&) const { return nullptr; }
  Json operator()(const Blobs&) const { return nullptr; }
};

/// Which readings come with every update only if a page wants them so; 2005's REQ_… ask for them.
bool isOnRequest(SensorKind kind) {
  return kind == SensorKind::sonar || kind == SensorKind::laser || kind == SensorKind::heat ||
         kind == SensorKind::infrared;
}

Json jsonOf(const SensorInfo& sensor) {
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

Json jsonOf(const RemoteState& state) {
  return {{"autonomous", state.autonomous},       {"driver", state.driver},
          {"is_yours", state.is_yours},           {"speed_mps", fine(state.speed_mps)},
          {"turn_radps", fine(state.turn_radps)}, {"activity", nameOf(state.activity)},
          {"why_stopped", state.why_stopped}};
}

}  // namespace

std::string robotJson(const RobotInfo& robot, double period_s) {
  Json sensors = Json::array();
  for (const auto& sensor : *robot.sensors) sensors.push_back(jsonOf(sensor));
  return textOf({{"type", "robot"},
                 {"name", robot.name},
                 {"model", robot.model},
                 {"radius_m", robot.radius_m},
                 {"speed_max_mps", robot.limits.speed_max_mps},
                 {"turn_max_radps", robot.limits.turn_max_radps},
                 {"period_s", period_s},
                 {"sensors", sensors}});
}

std::string teamJson(const std::vector<RemoteControl::Robot>& robots, const Wheel& wheel) {
  Json team = Json::array();
  std::string winner, world;
  for (const auto& robot : robots) {
    const RobotNews& news = robot.news;
    team.push_back({{"name", robot.name},
                    {"address", robot.address},
                    {"model", news.info ? news.info->model : ""},
                    {"up", news.is_up},
                    {"problem", news.problem},
                    {"fit", robot.isFit()},
                    {"autonomous", news.state.autonomous},
                    {"driver", news.state.driver},
                    {"is_yours", news.state.is_yours},
                    {"activity", nameOf(news.state.activity)},
                    {"why_stopped", news.state.why_stopped}});
    if (!news.state.winner.empty()) winner = news.state.winner;
    if (!news.world.empty()) world = news.world;
  }
  return textOf({{"type", "team"},
                 {"world", world},
                 {"robots", team},
                 {"wheel", {{"holder", wheel.holder}, {"name", wheel.name}}},
                 {"guests", wheel.guests},
                 {"winner", winner}});
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
               {"laser_pan_rad", fine(readings.laser_pan_rad)},
               {"state", jsonOf(update.state)},
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

std::string mapJson(const MapView& map) {
  if (!map.world) return textOf({{"type", "map"}, {"problem", map.problem}});
  const MapWorld& world = *map.world;
  Json things = Json::array();
  for (const auto& thing : world.things) {
    things.push_back({{"at", jsonOf(thing.world_from_thing)},
                      {"length_m", thing.length_m},
                      {"width_m", thing.width_m},
                      {"radius_m", thing.radius_m},
                      {"color", hexOf(thing.color)},
                      {"hot", thing.is_hot}});
  }
  Json robots = Json::array();
  for (const auto& robot : world.robots) {
    robots.push_back({{"name", robot.name}, {"radius_m", robot.radius_m}, {"color", hexOf(robot.color)}});
  }
  return textOf({{"type", "map"},
                 {"name", world.name},
                 {"x_m", {world.x_min_m, world.x_max_m}},
                 {"y_m", {world.y_min_m, world.y_max_m}},
                 {"things", things},
                 {"robots", robots}});
}

std::string posesJson(const MapView& map) {
  Json robots = Json::array();
  for (std::size_t i = 0; i < map.world_from_robot.size(); ++i) {
    robots.push_back({{"at", jsonOf(map.world_from_robot[i])}, {"activity", nameOf(map.activity[i])}});
  }
  return textOf({{"type", "poses"}, {"step", map.step}, {"robots", robots}});
}

std::string noteJson(const std::string& text, bool is_warning) {
  return textOf({{"type", "note"}, {"text", text}, {"warning", is_warning}});
}

}  // namespace robosim
