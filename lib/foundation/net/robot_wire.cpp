#include "net/robot_wire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "hardware/inbox_limit.h"
#include "hardware/led_color.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

/// Upper limit of StepAnswer.messages_dropped: no process composes that many in a step, and the run's total of 64 bits
/// cannot overflow.
constexpr std::uint64_t kMaxMessagesDropped = std::uint64_t{1} << 32;

void checkFinite(double value, const char* name, std::uint32_t robot) {
  if (std::isfinite(value)) return;
  throw WireError("the command for robot " + std::to_string(robot) + " has a " + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
}

void checkCount(std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw WireError("a reading of " + std::to_string(count) + " numbers where " + std::to_string(expected) + " belong");
}

/// The field of v1::Measurement for the numbers of a kind of measurement, as an array of `count` elements.
template <typename M>
auto* numbersOf(v1::Measurement& out, std::size_t count) {
  if constexpr (kConsistsOf<M, std::uint8_t>) {
    out.mutable_flags()->resize(count);
    return out.mutable_flags()->data();
  } else if constexpr (kConsistsOf<M, float>) {
    out.mutable_floats()->Resize(static_cast<int>(count), 0);
    return out.mutable_floats()->mutable_data();
  } else {
    out.mutable_doubles()->Resize(static_cast<int>(count), 0);
    return out.mutable_doubles()->mutable_data();
  }
}

template <typename M>
auto numbersOf(const v1::Measurement& in) {
  if constexpr (kConsistsOf<M, std::uint8_t>) {
    return std::span(reinterpret_cast<const std::uint8_t*>(in.flags().data()), in.flags().size());
  } else if constexpr (kConsistsOf<M, float>) {
    return std::span(in.floats().data(), static_cast<std::size_t>(in.floats_size()));
  } else {
    return std::span(in.doubles().data(), static_cast<std::size_t>(in.doubles_size()));
  }
}

template <typename M>
std::size_t numberCount(const M& measurement) {
  return Description<M>::records(measurement).size() * kFieldCount<M>;
}

template <typename M, typename Number>
void setChecked(M& out, std::span<const Number> numbers) {
  const std::string fault = setNumbers(out, numbers);
  if (!fault.empty()) throw WireError(fault);
}

/// Decodes the numbers of a kind of measurement; none are a step in which an intermittent sensor measured nothing.
template <typename M>
void decodeNumbers(const v1::Measurement& in, M& out) {
  if constexpr (std::is_same_v<M, Values>) {
    if (out.values.empty()) return;  // of a sensor of an unknown kind, which may have any numbers or a file
  }
  const auto numbers = numbersOf<M>(in);
  if constexpr (requires { Description<M>::isPresent(out) = false; }) {
    if (numbers.empty()) {
      forNumbers(out, [](const auto&, auto& number, std::size_t) { number = 0; });
      Description<M>::isPresent(out) = false;
      return;
    }
  }
  if constexpr (std::is_same_v<M, Odometry>) {  // without a lateral speed
    if (numbers.size() + 1 == numberCount(out)) {
      std::array<double, kFieldCount<M>> all{};
      std::copy(numbers.begin(), numbers.end(), all.begin());
      setChecked(out, std::span<const double>(all));
      return;
    }
  }
  checkCount(numbers.size(), numberCount(out));
  setChecked(out, numbers);
}

void encode(const RobotMessage& message, v1::InboxMessage& out) {
  out.set_from(message.from);
  out.set_text(message.text);
}

/// Whether the sensor measured something in this step.
bool isPresentIn(const Measurement& measurement) {
  return std::visit([](const auto& kind) { return isPresent(kind); }, measurement);
}

ProcessRobotIndex checkedRobot(std::uint32_t robot, std::size_t robots, const char* what) {
  if (robot < robots) return static_cast<ProcessRobotIndex>(robot);
  throw WireError(std::string(what) + " for robot " + std::to_string(robot) + " of " + std::to_string(robots) +
                  "; a connection may only command the robots of its hello, counted from 0");
}

CameraHeadCommand decode(const v1::CameraHead& in, std::uint32_t robot) {
  checkFinite(in.pan_rad(), "camera_head.pan_rad", robot);
  checkFinite(in.tilt_rad(), "camera_head.tilt_rad", robot);
  checkFinite(in.zoom(), "camera_head.zoom", robot);
  checkFinite(in.pan_radps(), "camera_head.pan_radps", robot);
  checkFinite(in.tilt_radps(), "camera_head.tilt_radps", robot);
  return {{in.pan_rad(), in.tilt_rad(), in.zoom() == 0 ? 1 : in.zoom()}, in.pan_radps(), in.tilt_radps()};
}

void decodeMessages(const v1::StepAnswer& in, std::size_t robots, RobotsAnswer& out) {
  out.messages.clear();
  std::vector<std::size_t> sent(in.messages().empty() ? 0 : robots, 0);
  for (const auto& message : in.messages()) {
    const ProcessRobotIndex robot = checkedRobot(message.process_robot(), robots, "a message");
    if (message.text().size() > kMaxMessageBytes) {
      throw WireError("a message of " + std::to_string(message.text().size()) + " bytes; the most is " +
                      std::to_string(kMaxMessageBytes));
    }
    if (message.to_all() && !message.to().empty())
      throw WireError("a message to all robots that also names a receiver; leave `to` empty");
    if (++sent[indexOf(robot)] > kMaxMessagesSent) {
      throw WireError("more than " + std::to_string(kMaxMessagesSent) + " messages of a robot in one step",
                      v1::ERROR_REASON_TOO_MANY_MESSAGES);
    }
    out.messages.push_back({robot, message.to(), message.text(), message.to_all()});
  }
  if (in.messages_dropped() > kMaxMessagesDropped) {
    throw WireError("messages_dropped is " + std::to_string(in.messages_dropped()) + "; the most is " +
                    std::to_string(kMaxMessagesDropped));
  }
  out.messages_dropped = in.messages_dropped();
}

}  // namespace

v1::Activity encode(Activity activity) {
  switch (activity) {
    case Activity::active:
      return v1::ACTIVITY_ACTIVE;
    case Activity::halted:
      return v1::ACTIVITY_HALTED;
    case Activity::found:
      return v1::ACTIVITY_FOUND;
    case Activity::absent:
      return v1::ACTIVITY_ABSENT;
  }
  return v1::ACTIVITY_UNSPECIFIED;
}

std::optional<Activity> decode(v1::Activity activity) {
  switch (activity) {
    case v1::ACTIVITY_ACTIVE:
      return Activity::active;
    case v1::ACTIVITY_HALTED:
      return Activity::halted;
    case v1::ACTIVITY_FOUND:
      return Activity::found;
    case v1::ACTIVITY_ABSENT:
      return Activity::absent;
    default:
      return std::nullopt;
  }
}

void encode(const Command& command, v1::Command& out) {
  out.set_speed_mps(command.speed_mps);
  out.set_turn_radps(command.turn_radps);
  out.set_laser_pan_rad(command.laser_pan_rad);
  out.set_activity(encode(command.activity == Activity::absent ? Activity::active : command.activity));
  out.set_by_driver(command.by_driver);
  out.set_emergency_stop(command.emergency_stop);
  out.set_grip(command.grip);
  out.set_led_color(command.led_color);
  out.set_lateral_mps(command.lateral_mps);
  if (command.camera_head == CameraHeadCommand{}) return out.clear_camera_head();
  const auto& [aim, pan_radps, tilt_radps] = *command.camera_head;
  v1::CameraHead& head = *out.mutable_camera_head();
  head.set_pan_rad(aim.pan_rad);
  head.set_tilt_rad(aim.tilt_rad);
  head.set_zoom(aim.zoom);
  head.set_pan_radps(pan_radps);
  head.set_tilt_radps(tilt_radps);
}

Command decode(const v1::Command& in, std::uint32_t robot) {
  checkFinite(in.speed_mps(), "speed_mps", robot);
  checkFinite(in.turn_radps(), "turn_radps", robot);
  checkFinite(in.laser_pan_rad(), "laser_pan_rad", robot);
  checkFinite(in.lateral_mps(), "lateral_mps", robot);
  const auto activity =
      in.activity() == v1::ACTIVITY_UNSPECIFIED ? std::optional(Activity::active) : decode(in.activity());
  if (!activity || activity == Activity::absent) {
    throw WireError("the command for robot " + std::to_string(robot) + " has the activity " +
                    std::to_string(in.activity()) + "; there are 1 (active), 2 (halted) and 3 (found)");
  }
  return {in.speed_mps(),     in.turn_radps(),
          in.laser_pan_rad(), *activity,
          in.by_driver(),     in.emergency_stop(),
          in.grip(),          in.led_color() & kLedColorMax,
          in.lateral_mps(),   in.has_camera_head() ? decode(in.camera_head(), robot) : CameraHeadCommand{}};
}

void decode(const v1::StepAnswer& in, std::size_t robots, RobotsAnswer& out) {
  out.step = in.step();
  out.orders.clear();
  for (const auto& order : in.commands()) {
    const ProcessRobotIndex robot = checkedRobot(order.process_robot(), robots, "a command");
    out.orders.push_back({robot, decode(order.command(), order.process_robot())});
  }
  decodeMessages(in, robots, out);
  out.win_checks.clear();
  for (const auto robot : in.win_checks()) out.win_checks.push_back(checkedRobot(robot, robots, "a CheckWin request"));
  out.pictures.clear();
  for (const auto robot : in.pictures()) out.pictures.push_back(checkedRobot(robot, robots, "a request for pictures"));
}

void encode(const Measurement& measurement, v1::Measurement& out) {
  out.Clear();
  std::visit(
      [&]<typename M>(const M& kind) {
        if constexpr (kIsFile<M>) {
          (kind.raw ? out.mutable_raw_picture() : out.mutable_jpeg())->assign(Description<M>::file(kind));
        } else if (isPresent(kind)) {
          auto* next = numbersOf<M>(out, numberCount(kind));
          forNumbers(kind, [&](const auto&, auto number, std::size_t) {
            *next++ = static_cast<std::remove_reference_t<decltype(*next)>>(number);
          });
          // Odometry without a lateral speed, as that of most drives, is sent as it was before there were others.
          if constexpr (std::is_same_v<M, Odometry>) {
            if (kind.lateral_mps == 0) out.mutable_doubles()->Truncate(static_cast<int>(kFieldCount<M> - 1));
          }
        }
      },
      measurement);
}

void decode(const v1::Measurement& in, Measurement& out) {
  std::visit(
      [&]<typename M>(M& kind) {
        if constexpr (kIsFile<M>) {
          try {
            Description<M>::setFile(kind, in.raw_picture().empty() ? in.jpeg() : in.raw_picture());
          } catch (const std::invalid_argument& fault) {
            throw WireError(fault.what());
          }
        } else {
          decodeNumbers(in, kind);
        }
      },
      out);
}

void encode(const Readings& readings, v1::RobotReadings& out, std::optional<std::uint64_t> sent_step) {
  out.Clear();
  const bool is_new = !sent_step || readings.time.step > *sent_step;
  for (const auto& measurement : readings.measurements) {
    v1::Measurement& added = *out.add_measurements();
    encode(measurement, added);
    if (!isPresentIn(measurement)) continue;
    added.set_step(readings.time.step);
    added.set_is_new(is_new);
  }
  out.set_stalled(readings.stalled);
  out.set_laser_pan_rad(readings.laser_pan_rad);
  out.set_is_too_far(readings.is_too_far);
  for (const auto& message : readings.inbox) encode(message, *out.add_inbox());
}

void encodeInbox(const std::vector<RobotMessage>& messages, v1::RobotReadings& out) {
  out.clear_inbox();
  for (const auto& message : messages) encode(message, *out.add_inbox());
}

void decode(const v1::RobotReadings& in, const std::string& to, Readings& out) {
  if (static_cast<std::size_t>(in.measurements_size()) != out.measurements.size()) {
    throw WireError("readings of " + std::to_string(in.measurements_size()) + " sensors for a robot that has " +
                    std::to_string(out.measurements.size()));
  }
  for (int i = 0; i < in.measurements_size(); ++i) {
    if (in.measurements(i).step() > out.time.step) {
      throw WireError("a measurement of step " + std::to_string(in.measurements(i).step()) + " in step " +
                      std::to_string(out.time.step));
    }
    decode(in.measurements(i), out.measurements[static_cast<std::size_t>(i)]);
  }
  out.stalled = in.stalled();
  out.laser_pan_rad = in.laser_pan_rad();
  out.is_too_far = in.is_too_far();
  out.inbox.clear();
  for (const auto& message : in.inbox()) out.inbox.edit().push_back({message.from(), to, message.text()});
}

void checkPictures(const Readings& readings, const std::vector<SensorInfo>& sensors) {
  if (const char* fault = pictureFaultOf(readings.measurements, sensors)) throw WireError(fault);
}

Readings blankReadings(const std::vector<SensorInfo>& sensors) {
  Readings readings;
  for (const auto& sensor : sensors) readings.measurements.push_back(blankMeasurement(sensor));
  return readings;
}

}  // namespace robosim
