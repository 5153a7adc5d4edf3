#include "net/robot_wire.h"

#include <cmath>
#include <span>

#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

static_assert(static_cast<int>(Activity::active) == wire::ACTIVE &&
              static_cast<int>(Activity::halted) == wire::HALTED && static_cast<int>(Activity::found) == wire::FOUND);

void checkRobot(std::uint32_t robot, std::size_t robots, const char* what) {
  if (robot < robots) return;
  throw WireError(std::string(what) + " for robot " + std::to_string(robot) + " of " + std::to_string(robots) +
                  "; a connection may only command the robots of its hello, counted from 0");
}

void checkFinite(double value, const char* name, std::uint32_t robot) {
  if (std::isfinite(value)) return;
  throw WireError("the command for robot " + std::to_string(robot) + " has a " + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
}

void checkCount(std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw WireError("a reading of " + std::to_string(count) + " numbers where " + std::to_string(expected) + " belong");
}

/// The field of wire::Measurement for the numbers of a kind of measurement, as an array of `count` elements.
template <typename M>
auto* numbersOf(wire::Measurement& out, std::size_t count) {
  if constexpr (kConsistsOf<M, std::uint8_t>) {
    out.mutable_flags()->resize(count);
    return out.mutable_flags()->data();
  } else if constexpr (kConsistsOf<M, float>) {
    out.mutable_floats()->Resize(static_cast<int>(count), 0);
    return out.mutable_floats()->mutable_data();
  } else {
    out.mutable_numbers()->Resize(static_cast<int>(count), 0);
    return out.mutable_numbers()->mutable_data();
  }
}

template <typename M>
auto numbersOf(const wire::Measurement& in) {
  if constexpr (kConsistsOf<M, std::uint8_t>) {
    return std::span(reinterpret_cast<const std::uint8_t*>(in.flags().data()), in.flags().size());
  } else if constexpr (kConsistsOf<M, float>) {
    return std::span(in.floats().data(), static_cast<std::size_t>(in.floats_size()));
  } else {
    return std::span(in.numbers().data(), static_cast<std::size_t>(in.numbers_size()));
  }
}

template <typename M>
std::size_t numberCount(const M& measurement) {
  return Description<M>::records(measurement).size() * kFieldCount<M>;
}

/// Decodes the numbers of a kind of measurement; none are a step in which an intermittent sensor measured nothing.
template <typename M>
void decodeNumbers(const wire::Measurement& in, M& out) {
  const auto numbers = numbersOf<M>(in);
  if constexpr (requires { Description<M>::isPresent(out) = false; }) {
    if (numbers.empty()) {
      forNumbers(out, [](const auto&, auto& number, std::size_t) { number = 0; });
      Description<M>::isPresent(out) = false;
      return;
    }
  }
  checkCount(numbers.size(), numberCount(out));
  const std::string fault = setNumbers(out, numbers);
  if (!fault.empty()) throw WireError(fault);
}

void encode(const RobotMessage& message, wire::InboxLetter& out) {
  out.set_from(message.from);
  out.set_text(message.text);
}

}  // namespace

void encode(const Command& command, std::uint32_t robot, wire::RobotCommand& out) {
  out.set_robot(robot);
  out.set_speed_mps(command.speed_mps);
  out.set_turn_radps(command.turn_radps);
  out.set_laser_pan_rad(command.laser_pan_rad);
  out.set_activity(static_cast<wire::Activity>(command.activity));
  out.set_by_driver(command.by_driver);
}

Command decode(const wire::RobotCommand& in, std::size_t robots) {
  checkRobot(in.robot(), robots, "a command");
  checkFinite(in.speed_mps(), "speed_mps", in.robot());
  checkFinite(in.turn_radps(), "turn_radps", in.robot());
  checkFinite(in.laser_pan_rad(), "laser_pan_rad", in.robot());
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("the command for robot " + std::to_string(in.robot()) + " has the activity " +
                    std::to_string(in.activity()) + "; there are 0 (active), 1 (halted) and 2 (found)");
  }
  return {in.speed_mps(), in.turn_radps(), in.laser_pan_rad(), static_cast<Activity>(in.activity()), in.by_driver()};
}

void decode(const wire::DriveRequest& in, std::size_t robots, RobotsAnswer& out) {
  out.step = in.step();
  out.orders.clear();
  for (const auto& command : in.commands()) out.orders.push_back({command.robot(), decode(command, robots)});
  out.messages.clear();
  for (const auto& message : in.letters()) {
    checkRobot(message.robot(), robots, "a message");
    if (message.text().size() > kMaxMessageBytes) {
      throw WireError("a message of " + std::to_string(message.text().size()) + " bytes; the most is " +
                      std::to_string(kMaxMessageBytes));
    }
    out.messages.push_back({message.robot(), message.to(), message.text()});
  }
  out.win_checks.assign(in.check_win().begin(), in.check_win().end());
  for (const auto robot : out.win_checks) checkRobot(robot, robots, "a CheckWin request");
}

void encode(const Measurement& measurement, wire::Measurement& out) {
  out.Clear();
  std::visit(
      [&]<typename M>(const M& kind) {
        if constexpr (kIsFile<M>) {
          out.set_jpeg(Description<M>::file(kind));
        } else if (isPresent(kind)) {
          auto* next = numbersOf<M>(out, numberCount(kind));
          forNumbers(kind, [&](const auto&, auto number, std::size_t) {
            *next++ = static_cast<std::remove_reference_t<decltype(*next)>>(number);
          });
        }
      },
      measurement);
}

void decode(const wire::Measurement& in, Measurement& out) {
  std::visit(
      [&]<typename M>(M& kind) {
        if constexpr (kIsFile<M>) {
          if (const auto fault = Description<M>::fileFaultOf(in.jpeg()); !fault.empty()) throw WireError(fault);
          Description<M>::file(kind) = in.jpeg();
        } else {
          decodeNumbers(in, kind);
        }
      },
      out);
}

void encode(const Readings& readings, wire::RobotReadings& out) {
  out.Clear();
  for (const auto& measurement : readings.measurements) encode(measurement, *out.add_measurements());
  out.set_stalled(readings.stalled);
  out.set_laser_pan_rad(readings.laser_pan_rad);
  out.set_is_too_far(readings.is_too_far);
  for (const auto& message : readings.inbox) encode(message, *out.add_inbox());
}

void encodeInbox(const std::vector<RobotMessage>& messages, wire::RobotReadings& out) {
  out.clear_inbox();
  for (const auto& message : messages) encode(message, *out.add_inbox());
}

void decode(const wire::RobotReadings& in, const std::string& to, Readings& out) {
  if (static_cast<std::size_t>(in.measurements_size()) != out.measurements.size()) {
    throw WireError("readings of " + std::to_string(in.measurements_size()) + " sensors for a robot that has " +
                    std::to_string(out.measurements.size()));
  }
  for (int i = 0; i < in.measurements_size(); ++i) {
    decode(in.measurements(i), out.measurements[static_cast<std::size_t>(i)]);
  }
  out.stalled = in.stalled();
  out.laser_pan_rad = in.laser_pan_rad();
  out.is_too_far = in.is_too_far();
  out.inbox.clear();
  for (const auto& message : in.inbox()) out.inbox.push_back({message.from(), to, message.text()});
}

Readings blankReadings(const std::vector<SensorInfo>& sensors) {
  Readings readings;
  for (const auto& sensor : sensors) readings.measurements.push_back(blankMeasurement(sensor));
  return readings;
}

}  // namespace robosim
