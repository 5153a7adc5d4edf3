#include "arcos/client/arcos_hardware.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <mrpt/math/wrap2pi.h>

#include "arcos/protocol/bumpers.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/gripper_packet.h"
#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/portable_pose.h"
#include "hardware/gripper_state.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::encodeCommand;
using arcos::Sip;

constexpr double kMm = 1000;
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::seconds kStopMax{5};  ///< from 1 m/s at 0.3 m/s²: 3.3 s
constexpr int kLowBatterySips = 5;           ///< the voltage of a robot that accelerates drops for a moment
constexpr double kBatteryRecoveryVolts = 0.5;
constexpr const char* kLowBattery = "the battery is low";

/// Difference of two odometry counts, of which only the low 15 bits count.
int difference15(std::uint16_t now, std::uint16_t before) {
  const int difference = (now - before) & 0x7FFF;
  return difference >= 0x4000 ? difference - 0x8000 : difference;
}

/// Rounds a command, and keeps what is rounded off for the next one.
int rounded(double value, double& remainder) {
  const double wanted = value + remainder;
  const double sent = std::round(wanted);
  remainder = wanted - sent;
  return static_cast<int>(sent);
}

bool canReport(const SensorInfo& sensor) {
  const SensorKind kind = sensor.kind;
  return GripperState::isOf(sensor) || kind == SensorKind::sonar || kind == SensorKind::laser ||
         kind == SensorKind::bumper || kind == SensorKind::odometry || kind == SensorKind::compass ||
         kind == SensorKind::battery;
}

GripperState gripperFrom(const Sip& sip) {
  const auto switches = arcos::GripperSwitches::from(sip.gripper);
  // An object between closed paddles interrupts a light barrier.
  const bool holds = switches.is_closed && (switches.inner_beam || switches.outer_beam);
  return {switches.is_closed, holds, switches.inner_beam, switches.outer_beam};
}

SensorInfo batteryInfo() {
  SensorInfo info;
  info.kind = SensorKind::battery;
  info.label = "battery";
  return info;
}

Echo echoAt(const SensorInfo& sensor, std::size_t beam, double range_mm) {
  float range_m = static_cast<float>(range_mm / kMm);
  if (range_m >= static_cast<float>(sensor.range_max_m)) range_m = static_cast<float>(sensor.no_echo_m);
  return {range_m, pointAlong(originOf(sensor.beams[beam]), directionOf(sensor.beams[beam]), range_m)};
}

}  // namespace

ArcosHardware::ArcosHardware(std::unique_ptr<ByteChannel> channel, Options options)
    : channel_(std::move(channel)), options_(std::move(options)), names_{options_.name} {
  connect();
  describe(options_.type_of(client_.subclass()));
  configure();
  last_sip_ = client_.sip();
  takeReadings();
}

ArcosHardware::~ArcosHardware() {
  if (is_closed_) return;
  try {
    channel_->write(encodeCommand(command::stop) + encodeCommand(command::enable, 0) +
                    encodeCommand(command::close, 1));
  } catch (const std::exception&) {  // the connection is lost: the robot's watchdog stops it
  }
}

void ArcosHardware::close(const std::function<void()>& each_step) {
  is_closed_ = true;
  if (command_.activity == Activity::active) command_ = {.activity = Activity::halted};
  const auto start = channel_->now();
  const auto is_over = [&] { return channel_->now() - start >= kStopMax; };
  const auto is_standing = [&] { return client_.sip().speed_left == 0 && client_.sip().speed_right == 0; };
  try {
    while (awaitStep(is_over)) {
      each_step();
      if (is_standing()) break;
    }
  } catch (const ChannelEnd&) {  // of a log
    return;
  }
  channel_->write(encodeCommand(command::enable, 0) + encodeCommand(command::close, 1));
}

void ArcosHardware::connect() {
  const auto start = channel_->now();
  channel_->write(client_.receive({}, start));
  while (!client_.isReady()) {
    if (options_.interrupted()) throw Interrupted("interrupted; not connected to " + channel_->name());
    if (channel_->now() - start > kHandshakeMax) {
      throw RobotLinkError("no robot answers at " + channel_->name() +
                           (client_.subclass().empty() ? "; check that it is on, and its cable or address"
                                                       : ": it has answered, and sends no data"));
    }
    processArrived(channel_->read(kPoll));
  }
}

void ArcosHardware::processArrived(const std::string& bytes) {
  if (const std::string answer = client_.receive(bytes, channel_->now()); !answer.empty()) channel_->write(answer);
}

void ArcosHardware::describe(ArcosRobotType type) {
  info_ = std::move(type.info);
  info_.name = options_.name;
  parameters_ = type.parameters;
  if (const auto& config = client_.config()) {
    // What the robot is configured for, which is often less than it could do.
    const auto limit = [](double& value, double configured) {
      if (configured > 0) value = std::min(value, configured);
    };
    limit(info_.type.edit().limits.speed_max_mps, config->speed_max / kMm);
    limit(info_.type.edit().limits.turn_max_radps, config->turn_max * kRadPerDeg);
    limit(info_.type.edit().limits.accel_mps2, config->accel / kMm);
    limit(info_.type.edit().limits.decel_mps2, config->decel / kMm);
    limit(info_.type.edit().limits.turn_accel_radps2, std::min(config->turn_accel, config->turn_decel) * kRadPerDeg);
  }
  std::vector<SensorInfo> sensors;
  std::vector<std::string> missing{"CheckWin"};
  for (const SensorInfo& sensor : *info_.sensors) {
    const bool is_laser = sensor.kind == SensorKind::laser;
    // A board without a compass sends 0.
    const bool has_compass = client_.isSimulated() || client_.sip().compass != 0;
    const bool has_source =
        is_laser ? options_.laser || (options_.requests_laser && client_.isSimulated() && canCarryScans(sensor))
        : sensor.kind == SensorKind::compass ? has_compass
        : GripperState::isOf(sensor)         ? client_.config() && client_.config()->has_gripper
                                             : true;
    if (canReport(sensor) && has_source) {
      sensors.push_back(sensor);
    } else {
      missing.push_back(sensor.label);
    }
    has_simulated_laser_ |= is_laser && has_source && !options_.laser;
  }
  const auto is_battery = [](const SensorInfo& sensor) { return sensor.kind == SensorKind::battery; };
  if (std::none_of(sensors.begin(), sensors.end(), is_battery)) sensors.push_back(batteryInfo());
  for (const auto& sensor : sensors) {
    readings_.measurements.push_back(blankMeasurement(sensor));
    if (GripperState::isOf(sensor)) readings_.measurements.back() = GripperState{}.values();
  }
  info_.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  readings_.time.period_s = arcos::kCycle_s;
  if (const auto& config = client_.config(); config && config->cycle_ms > 0) {
    readings_.time.period_s = config->cycle_ms / 1000.0;
  }
  options_.log("connected to " + client_.robotName() + " (" + client_.subclass() + ") at " + channel_->name() +
               "; not available: " + listed(missing));
}

/// Whether the line carries the simulated scans of a laser beside the SIPs, which would be late otherwise.
bool ArcosHardware::canCarryScans(const SensorInfo& laser) const {
  const auto capacity = channel_->capacity();
  if (!capacity) return true;
  constexpr double kSipBytes = 100;  // of one with 16 sonars, and some reserve
  const std::vector<std::uint16_t> ranges(laser.beams.size());
  const auto scan_bytes =
      static_cast<double>(arcos::encodeScan(arcos::LaserRequest::Form::extended, {.ranges_mm = ranges}, false).size());
  const double needed = (scan_bytes + kSipBytes) / arcos::kCycle_s;
  if (needed <= *capacity) return true;
  options_.log("the scans of '" + laser.label + "' need a line of " + std::to_string(std::lround(needed * 10)) +
               " baud; open " + channel_->name() + " with a higher rate, as in serial:DEVICE:115200");
  return false;
}

void ArcosHardware::configure() {
  const MotionLimits& limits = info_.type->limits;
  const auto mm = [](double metres) { return static_cast<int>(std::lround(metres * kMm)); };
  const auto deg = [](double rad) { return static_cast<int>(std::lround(rad / kRadPerDeg)); };
  std::string commands =
      encodeCommand(command::setv, mm(limits.speed_max_mps)) + encodeCommand(command::seta, mm(limits.accel_mps2)) +
      encodeCommand(command::seta, -mm(limits.decel_mps2)) + encodeCommand(command::setrv, deg(limits.turn_max_radps)) +
      encodeCommand(command::setra, deg(limits.turn_accel_radps2)) +
      encodeCommand(command::setra, -deg(limits.turn_accel_radps2)) + encodeCommand(command::enable, 1) +
      encodeCommand(command::sonar, 1);
  if (has_simulated_laser_) {
    const auto laser = std::find_if(info_.sensors->begin(), info_.sensors->end(),
                                    [](const SensorInfo& sensor) { return sensor.kind == SensorKind::laser; });
    const double first_rad = laser->beams.front().robot_from_beam.yaw,
                 last_rad = laser->beams.back().robot_from_beam.yaw;
    const double step_rad = (last_rad - first_rad) / std::max<double>(1, static_cast<double>(laser->beams.size()) - 1);
    commands +=
        encodeCommand(command::old_laser_start, deg(first_rad)) + encodeCommand(command::old_laser_end, deg(last_rad)) +
        encodeCommand(command::old_laser_increment, deg(step_rad * 100)) + encodeCommand(command::old_laser_enable, 2);
  }
  channel_->write(commands);
}

void ArcosHardware::send(const std::string& to, const std::string&) {
  throw std::invalid_argument("a message to '" + to + "': a robot at " + channel_->name() +
                              " is alone, and exchanges no messages");
}

void ArcosHardware::enableMotors(bool on) {
  motors_wanted_ = on;
  channel_->write(encodeCommand(command::enable, on ? 1 : 0));
}

void ArcosHardware::enableSonar(bool on) { channel_->write(encodeCommand(command::sonar, on ? 1 : 0)); }

void ArcosHardware::sendGrip() {
  if (std::exchange(has_closed_gripper_, command_.grip) == command_.grip) return;
  namespace operation = arcos::gripper_operation;
  channel_->write(encodeCommand(command::gripper, command_.grip ? operation::close : operation::open));
}

void ArcosHardware::sendCommand() {
  sendGrip();
  const bool may_move = base_.stop_reason.empty() && command_.activity == Activity::active;
  if (!may_move || command_.emergency_stop) {
    unsent_mmps_ = unsent_degps_ = 0;
    channel_->write(encodeCommand(command_.emergency_stop ? command::estop : command::stop));
    return;
  }
  const auto limited = [](double value, double limit) {
    return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0;
  };
  const double mmps = limited(command_.speed_mps, info_.type->limits.speed_max_mps) * kMm;
  const double degps = limited(command_.turn_radps, info_.type->limits.turn_max_radps) / kRadPerDeg;
  channel_->write(encodeCommand(command::vel, rounded(mmps, unsent_mmps_)) +
                  encodeCommand(command::rvel, rounded(degps, unsent_degps_)));
}

bool ArcosHardware::isStepComplete() const {
  const std::uint64_t new_sips = client_.sips() - sips_taken_;
  if (new_sips == 0) return false;
  // The scan follows its SIP; if none has come by the next SIP, the robot sends none.
  return !has_simulated_laser_ || client_.scans() > scans_taken_ || new_sips > 1;
}

bool ArcosHardware::nextStep() {
  try {
    return awaitStep(options_.interrupted);
  } catch (const ChannelEnd& end) {
    options_.log(end.what());
    return false;
  }
}

bool ArcosHardware::awaitStep(const std::function<bool()>& is_over) {
  sendCommand();
  sips_taken_ = client_.sips();
  scans_taken_ = client_.scans();
  const auto start = channel_->now();
  bool has_warned = false;
  while (!isStepComplete()) {
    if (is_over()) return false;
    const auto silent = channel_->now() - start;
    if (silent > kSilenceMax) {
      throw RobotLinkError("the robot at " + channel_->name() + " has sent nothing for " +
                           std::to_string(kSilenceMax.count()) + " s; it has stopped by its watchdog");
    }
    if (silent > kSilenceWarning && !std::exchange(has_warned, true)) {
      options_.log("the robot has sent nothing for " + std::to_string(kSilenceWarning.count()) + " s");
      channel_->write(encodeCommand(command::stop));
    }
    processArrived(channel_->read(kPoll));
  }
  was_silent_ = has_warned;
  ++readings_.time.step;
  takeReadings();
  return true;
}

void ArcosHardware::takeReadings() {
  takeOdometry();
  const Sip& sip = client_.sip();
  for (std::size_t i = 0; i < info_.sensors->size(); ++i) {
    const SensorInfo& sensor = (*info_.sensors)[i];
    Measurement& measurement = readings_.measurements[i];
    switch (sensor.kind) {
      case SensorKind::sonar:
        takeSonar(measurement);
        break;
      case SensorKind::laser:
        takeScan(sensor, measurement);
        break;
      case SensorKind::bumper:
        takeBumpers(sensor, measurement);
        break;
      case SensorKind::compass:
        // Clockwise from north, the y axis of the world.
        measurement = Scalar{mrpt::math::wrapToPi(M_PI_2 - sip.compass * 2 * kRadPerDeg)};
        break;
      case SensorKind::battery:
        measurement = Scalar{std::max<int>(sip.battery, sip.battery_decivolts) / 10.0};
        break;
      case SensorKind::values:
        measurement = gripperFrom(sip).values();
        break;
      default:
        break;
    }
  }
  takeBaseState();
  last_sip_ = sip;
}

void ArcosHardware::takeOdometry() {
  const Sip& sip = client_.sip();
  board_from_robot_.x += difference15(sip.x, last_sip_.x) * parameters_.distance_unit_mm / kMm;
  board_from_robot_.y += difference15(sip.y, last_sip_.y) * parameters_.distance_unit_mm / kMm;
  board_from_robot_.phi = mrpt::math::wrapToPi(sip.heading * 2 * M_PI / arcos::kHeadingUnitsPerTurn);
  if (readings_.time.step == 0) board_from_start_ = board_from_robot_;
  const double wheels_radps = (sip.speed_right - sip.speed_left) / 2.0 * parameters_.turn_radpmm;
  const Odometry odometry{portable::relative(board_from_start_, board_from_robot_),
                          (sip.speed_left + sip.speed_right) / 2.0 / kMm,
                          sip.turn_rate != 0 ? sip.turn_rate / 10.0 * kRadPerDeg : wheels_radps};
  for (std::size_t i = 0; i < info_.sensors->size(); ++i) {
    if ((*info_.sensors)[i].kind == SensorKind::odometry) readings_.measurements[i] = odometry;
  }
}

void ArcosHardware::takeSonar(Measurement& measurement) const {
  const auto sensor = std::find_if(info_.sensors->begin(), info_.sensors->end(),
                                   [](const SensorInfo& info) { return info.kind == SensorKind::sonar; });
  if ((client_.sip().flags & Sip::kSonarOn) == 0) measurement = blankMeasurement(*sensor);  // switched off
  auto& echoes = std::get<Echoes>(measurement);
  for (const Sip::Sonar& sonar : client_.sip().sonars) {
    if (sonar.index < echoes.size()) echoes[sonar.index] = echoAt(*sensor, sonar.index, sonar.range);
  }
}

void ArcosHardware::takeScan(const SensorInfo& laser, Measurement& measurement) {
  const std::vector<std::uint16_t> ranges = options_.laser ? options_.laser->latestScan() : client_.scan();
  auto& echoes = std::get<Echoes>(measurement);
  has_laser_answered_ = !options_.laser || ranges.size() == echoes.size();
  if (ranges.size() != echoes.size()) return;
  for (std::size_t i = 0; i < echoes.size(); ++i) echoes[i] = echoAt(laser, i, ranges[i]);
}

void ArcosHardware::takeBumpers(const SensorInfo& bumper, Measurement& measurement) const {
  auto& pressed = std::get<Contacts>(measurement).pressed;
  for (std::size_t i = 0; i < pressed.size(); ++i) {
    const auto place = arcos::bumperAt(bumper.beams[i].robot_from_beam.yaw, parameters_);
    const auto bits = place.is_front ? client_.sip().stall_right : client_.sip().stall_left;
    pressed[i] = place.bit != 0 && (bits & place.bit) != 0;
  }
}

void ArcosHardware::takeBaseState() {
  const Sip& sip = client_.sip();
  const std::string before = base_.stop_reason;
  base_.motors_enabled = (sip.flags & Sip::kMotorsOn) != 0;
  base_.estop_pressed = (sip.flags & Sip::kEstopPressed) != 0;
  base_.left_stalled = (sip.stall_left & Sip::kStalled) != 0;
  base_.right_stalled = (sip.stall_right & Sip::kStalled) != 0;
  if (sip.charge_percent > 0) base_.charge_percent = sip.charge_percent;
  readings_.stalled = *base_.left_stalled || *base_.right_stalled;
  const double battery_volts = std::max<int>(sip.battery, sip.battery_decivolts) / 10.0;
  const double low_volts = client_.config() && client_.config()->low_battery_decivolts > 0
                               ? client_.config()->low_battery_decivolts / 10.0
                               : parameters_.low_battery_volts;
  const double limit_volts = before == kLowBattery ? low_volts + kBatteryRecoveryVolts : low_volts;
  low_battery_sips_ = battery_volts > 0 && battery_volts < limit_volts ? low_battery_sips_ + 1 : 0;
  // The motors take a moment to be enabled after the start.
  const bool had_motors = readings_.time.step > 10;
  base_.stop_reason = was_silent_                            ? "the robot had sent nothing for a while"
                      : *base_.estop_pressed                 ? "the emergency stop is pressed"
                      : low_battery_sips_ >= kLowBatterySips ? kLowBattery
                      : !*base_.motors_enabled && (had_motors || !motors_wanted_) ? "the motors are disabled"
                      : !has_laser_answered_                                      ? "the laser scanner does not answer"
                                                                                  : "";
  if (base_.stop_reason == before) return;
  options_.log(base_.stop_reason.empty() ? "the robot may move again; resolved: " + before
                                         : "the robot stops: " + base_.stop_reason);
}

}  // namespace robosim
