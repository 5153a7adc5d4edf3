#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hardware/measurement_fields.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

void checkFinite(std::initializer_list<double> values) {
  if (std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) return;
  throw WireError("the environment's welcome has a number that is not finite");
}

void addField(const char* name, const Unit& unit, v1::SensorDescription& out) {
  auto& field = *out.add_fields();
  field.set_name(name);
  field.set_unit(unit.symbol);
}

/// Adds the names and units of the numbers of a kind of measurement.
template <typename M>
void describeRecords(const M&, v1::SensorDescription& out) {
  out.set_record(Description<M>::record_name);
  std::apply([&](const auto&... field) { (addField(field.name, field.unit, out), ...); }, Description<M>::fields);
}

void encode(const Beam& beam, v1::Beam& out) {
  const auto& pose = beam.robot_from_beam;
  out.set_x_m(pose.x);
  out.set_y_m(pose.y);
  out.set_z_m(pose.z);
  out.set_yaw_rad(pose.yaw);
  out.set_pitch_rad(pose.pitch);
  out.set_roll_rad(pose.roll);
}

Beam decode(const v1::Beam& in) {
  checkFinite({in.x_m(), in.y_m(), in.z_m(), in.yaw_rad(), in.pitch_rad(), in.roll_rad()});
  return {{in.x_m(), in.y_m(), in.z_m(), in.yaw_rad(), in.pitch_rad(), in.roll_rad()}};
}

void encode(const CameraHeadLimits& head, v1::CameraHeadLimits& out) {
  out.set_pan_min_rad(head.pan_min_rad);
  out.set_pan_max_rad(head.pan_max_rad);
  out.set_tilt_min_rad(head.tilt_min_rad);
  out.set_tilt_max_rad(head.tilt_max_rad);
  out.set_zoom_max(head.zoom_max);
  out.set_pan_radps(head.pan_radps);
  out.set_tilt_radps(head.tilt_radps);
  out.set_zoom_per_s(head.zoom_per_s);
}

CameraHeadLimits decode(const v1::CameraHeadLimits& in) {
  checkFinite({in.pan_min_rad(), in.pan_max_rad(), in.tilt_min_rad(), in.tilt_max_rad(), in.zoom_max(), in.pan_radps(),
               in.tilt_radps(), in.zoom_per_s()});
  const bool has_straight_ahead =
      in.pan_min_rad() <= 0 && in.pan_max_rad() >= 0 && in.tilt_min_rad() <= 0 && in.tilt_max_rad() >= 0;
  const bool has_speeds = in.pan_radps() >= 0 && in.tilt_radps() >= 0 && in.zoom_per_s() >= 0;
  if (!has_straight_ahead || !has_speeds || in.zoom_max() < 1 || in.zoom_max() > 100) {
    throw WireError("a camera's head with impossible limits");
  }
  return {in.pan_min_rad(), in.pan_max_rad(), in.tilt_min_rad(), in.tilt_max_rad(),
          in.zoom_max(),    in.pan_radps(),   in.tilt_radps(),   in.zoom_per_s()};
}

void encode(const SensorInfo& sensor, v1::SensorDescription& out) {
  out.set_kind(nameOf(sensor.kind));
  out.set_label(sensor.label);
  std::visit([&](const auto& kind) { describeRecords(kind, out); }, blankMeasurement(sensor));
  for (const auto& beam : sensor.beams) encode(beam, *out.add_beams());
  out.set_range_min_m(sensor.range_min_m);
  out.set_range_max_m(sensor.range_max_m);
  out.set_no_echo_m(sensor.no_echo_m);
  out.set_beam_width_rad(sensor.beam_width_rad);
  out.set_noise_std_m(sensor.noise_std_m);
  out.set_pans(sensor.pans);
  out.set_bearing_std_rad(sensor.bearing_std_rad);
  out.set_rate_hz(sensor.times.rate_hz);
  out.set_phase_s(sensor.times.phase_s);
  if (sensor.camera.width_px != 0) {
    auto& camera = *out.mutable_camera();
    camera.set_width_px(sensor.camera.width_px);
    camera.set_height_px(sensor.camera.height_px);
    camera.set_field_of_view_rad(sensor.camera.field_of_view_rad);
    camera.set_rate_hz(sensor.camera.rate_hz);
    if (!sensor.camera.distortion.isNone()) {
      for (const double coefficient : sensor.camera.distortion.coefficients()) camera.add_distortion(coefficient);
    }
    camera.set_rgb(sensor.camera.layers.rgb);
    camera.set_depth(sensor.camera.layers.depth);
    camera.set_identity(sensor.camera.layers.identity);
  }
  if (sensor.head != CameraHeadLimits{}) encode(sensor.head, *out.mutable_head());
  for (const auto& color : sensor.colors) out.add_colors(color);
  for (const auto& quantity : sensor.quantities) {
    auto& added = *out.add_quantities();
    added.set_name(quantity.name);
    added.set_unit(quantity.unit);
  }
}

CameraInfo decode(const v1::CameraDescription& in) {
  const auto is_side = [](std::uint32_t px) { return px >= 1 && px <= kPictureSideMax_px; };
  if (!is_side(in.width_px()) || !is_side(in.height_px()) ||
      !(in.field_of_view_rad() > 0 && in.field_of_view_rad() < M_PI) || !(in.rate_hz() > 0)) {
    throw WireError("a camera with invalid parameters");
  }
  checkFinite({in.rate_hz()});
  CameraInfo camera{in.width_px(), in.height_px(), in.field_of_view_rad(), in.rate_hz()};
  camera.layers = {in.rgb(), in.depth(), in.identity()};
  if (in.distortion_size() == 0) return camera;
  if (in.distortion_size() != 5) throw WireError("a camera whose lens has no five coefficients");
  for (const double coefficient : in.distortion()) checkFinite({coefficient});
  camera.distortion = {in.distortion(0), in.distortion(1), in.distortion(2), in.distortion(3), in.distortion(4)};
  return camera;
}

SensorInfo decode(const v1::SensorDescription& in) {
  SensorInfo sensor;
  // Environments of newer versions may have further kinds.
  sensor.kind = sensorKindNamed(in.kind()).value_or(SensorKind::unknown);
  sensor.label = in.label();
  for (const auto& beam : in.beams()) sensor.beams.push_back(decode(beam));
  checkFinite({in.range_min_m(), in.range_max_m(), in.no_echo_m(), in.beam_width_rad(), in.noise_std_m()});
  sensor.range_min_m = in.range_min_m();
  sensor.range_max_m = in.range_max_m();
  sensor.no_echo_m = in.no_echo_m();
  sensor.beam_width_rad = in.beam_width_rad();
  sensor.noise_std_m = in.noise_std_m();
  sensor.pans = in.pans();
  checkFinite({in.bearing_std_rad(), in.rate_hz(), in.phase_s()});
  sensor.bearing_std_rad = in.bearing_std_rad();
  sensor.times = {in.rate_hz(), in.phase_s()};
  const bool has_camera = sensor.kind == SensorKind::camera || sensor.kind == SensorKind::blob_finder;
  if (has_camera && sensor.beams.size() != 1) throw WireError("a camera has one place on the robot");
  if (has_camera) sensor.camera = decode(in.camera());
  if (in.has_head()) sensor.head = decode(in.head());
  sensor.colors.assign(in.colors().begin(), in.colors().end());
  for (const auto& quantity : in.quantities()) sensor.quantities.push_back({quantity.name(), quantity.unit()});
  return sensor;
}

void encode(const Drive& drive, v1::Drive& out) {
  out.set_kind(static_cast<v1::DriveKind>(static_cast<int>(drive.kind) + v1::DRIVE_KIND_DIFFERENTIAL));
  out.set_wheelbase_m(drive.wheelbase_m);
  out.set_steering_max_rad(drive.steering_max_rad);
  out.set_steering_rate_radps(drive.steering_rate_radps);
  out.set_track_factor(drive.track_factor);
  out.set_icr_x_m(drive.icr_x_m);
  out.set_assumed_factor(drive.assumed_factor);
}

/// A kind that this version does not know is a differential drive to it.
Drive decode(const v1::Drive& in) {
  Drive drive;
  if (in.kind() <= v1::DRIVE_KIND_DIFFERENTIAL || in.kind() > v1::DRIVE_KIND_TRACKED) return drive;
  checkFinite({in.wheelbase_m(), in.steering_max_rad(), in.steering_rate_radps(), in.track_factor(), in.icr_x_m(),
               in.assumed_factor()});
  drive.kind = static_cast<DriveKind>(in.kind() - v1::DRIVE_KIND_DIFFERENTIAL);
  drive.wheelbase_m = in.wheelbase_m();
  drive.steering_max_rad = in.steering_max_rad();
  drive.steering_rate_radps = in.steering_rate_radps();
  drive.track_factor = in.track_factor();
  drive.icr_x_m = in.icr_x_m();
  drive.assumed_factor = in.assumed_factor();
  return drive;
}

void encode(const RobotsWelcome::Robot& robot, std::uint32_t sensor_set, v1::RobotDescription& out) {
  const RobotInfo& info = robot.info;
  out.set_name(info.name);
  out.set_model(info.type->model);
  out.set_neighbour(*info.neighbour);
  out.set_radius_m(info.radius_m);
  out.set_height_m(info.height_m);
  out.set_speed_max_mps(info.type->limits.speed_max_mps);
  out.set_turn_max_radps(info.type->limits.turn_max_radps);
  out.set_accel_mps2(info.type->limits.accel_mps2);
  out.set_decel_mps2(info.type->limits.decel_mps2);
  out.set_turn_accel_radps2(info.type->limits.turn_accel_radps2);
  out.set_emergency_decel_mps2(info.type->limits.emergency_decel_mps2);
  if (info.type->drive != Drive()) encode(info.type->drive, *out.mutable_drive());
  out.set_lateral_max_mps(info.type->limits.lateral_max_mps);
  out.set_sensor_set(sensor_set);
  out.set_world_robot(robot.world_robot);
  out.set_controller(robot.controller);
  out.set_next_answer(robot.next_answer);
  if (info.color_rgb) out.set_color_rgb(*info.color_rgb);
  if (!robot.world_from_start) return;
  auto& start = *out.mutable_start();
  start.set_x_m(robot.world_from_start->x);
  start.set_y_m(robot.world_from_start->y);
  start.set_heading_rad(robot.world_from_start->phi);
}

using SensorSets = std::vector<std::shared_ptr<const std::vector<SensorInfo>>>;

RobotsWelcome::Robot decode(const v1::RobotDescription& in, const SensorSets& sets) {
  if (in.sensor_set() >= sets.size()) throw WireError("a robot refers to a set of sensors that does not exist");
  const MotionLimits limits{.speed_max_mps = in.speed_max_mps(),
                            .turn_max_radps = in.turn_max_radps(),
                            .accel_mps2 = in.accel_mps2(),
                            .decel_mps2 = in.decel_mps2(),
                            .turn_accel_radps2 = in.turn_accel_radps2(),
                            .emergency_decel_mps2 = in.emergency_decel_mps2(),
                            .lateral_max_mps = in.lateral_max_mps()};
  checkFinite({in.radius_m(), in.height_m(), limits.speed_max_mps, limits.turn_max_radps, limits.accel_mps2,
               limits.decel_mps2, limits.turn_accel_radps2, limits.emergency_decel_mps2, limits.lateral_max_mps});
  std::optional<std::uint32_t> color_rgb;
  if (in.has_color_rgb()) color_rgb = in.color_rgb() & 0xffffff;
  checkFinite({in.start().x_m(), in.start().y_m(), in.start().heading_rad()});
  std::optional<mrpt::math::TPose2D> world_from_start;
  if (in.has_start()) world_from_start.emplace(in.start().x_m(), in.start().y_m(), in.start().heading_rad());
  return {{in.name(), RobotTypeInfo{in.model(), limits, decode(in.drive())}, in.neighbour(), in.radius_m(),
           in.height_m(), sets[in.sensor_set()], color_rgb},
          in.world_robot(),
          in.controller(),
          in.next_answer(),
          world_from_start};
}

}  // namespace

void encode(const RobotsWelcome& welcome, v1::RobotsWelcome& out) {
  out.Clear();
  out.set_world(welcome.world);
  out.set_world_version(welcome.world_version);
  out.set_run(welcome.run);
  out.set_seed(welcome.seed);
  out.set_period_s(welcome.period_s);
  std::map<const std::vector<SensorInfo>*, std::uint32_t> set_of;
  for (const auto& robot : welcome.robots) {
    const auto* sensors = robot.info.sensors.get();
    const auto [found, is_new] = set_of.emplace(sensors, static_cast<std::uint32_t>(set_of.size()));
    if (is_new) {
      auto& set = *out.add_sensor_sets();
      for (const auto& sensor : *sensors) encode(sensor, *set.add_sensors());
    }
    encode(robot, found->second, *out.add_robots());
  }
  for (const auto& name : welcome.all_robots) out.add_all_robots(name);
  out.set_takes_broadcasts(welcome.takes_broadcasts);
}

RobotsWelcome decode(const v1::RobotsWelcome& in) {
  if (!(in.period_s() > 0 && in.period_s() <= 1)) throw WireError("the environment's time step is not in (0, 1] s");
  RobotsWelcome welcome;
  welcome.world = in.world();
  welcome.world_version = in.world_version();
  welcome.run = in.run();
  welcome.seed = in.seed();
  welcome.period_s = in.period_s();
  SensorSets sets;
  for (const auto& set : in.sensor_sets()) {
    auto sensors = std::make_shared<std::vector<SensorInfo>>();
    for (const auto& sensor : set.sensors()) sensors->push_back(decode(sensor));
    sets.push_back(std::move(sensors));
  }
  for (const auto& robot : in.robots()) {
    RobotsWelcome::Robot decoded = decode(robot, sets);
    // Robots of a type share what they have in common, as in the environment's process.
    if (!welcome.robots.empty() && welcome.robots.back().info.type == decoded.info.type) {
      decoded.info.type = welcome.robots.back().info.type;
    }
    welcome.robots.push_back(std::move(decoded));
  }
  welcome.all_robots.assign(in.all_robots().begin(), in.all_robots().end());
  welcome.takes_broadcasts = in.takes_broadcasts();
  return welcome;
}

}  // namespace robosim
