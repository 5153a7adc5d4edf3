#include "remote/orders.h"

#include <cmath>

#include "base/utf8.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

using Request = v1::ControlRequest;

void checkFinite(double value, const char* name) {
  if (std::isfinite(value)) return;
  throw WireError(std::string("a drive command with a ") + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
}

bool isOfRow(const Request& order, const OrderRow& row) {
  if (order.request_case() != row.request) return false;
  if (row.rule == OrderRule::steer) return order.steer().steering() == row.steering;
  return row.rule != OrderRule::request || order.req_reading().kind() == nameOf(row.sensor);
}

/// "'heat', 'laser' and 'sonar'"
std::string namesOfReadings() {
  std::string names;
  for (std::size_t i = 0; i < kReadings; ++i) {
    names += (i == 0 ? "" : i + 1 < kReadings ? ", " : " and ") + inQuotes(nameOf(readingRow(i).sensor));
  }
  return names;
}

}  // namespace

Request makeOrder(OrderType type) {
  const OrderRow& row = rowOf(type);
  Request order;
  // The case is the number of the field.
  order.GetReflection()->MutableMessage(&order, Request::descriptor()->FindFieldByNumber(row.request));
  if (row.rule == OrderRule::steer) order.mutable_steer()->set_steering(row.steering);
  if (row.rule == OrderRule::request) order.mutable_req_reading()->set_kind(nameOf(row.sensor));
  return order;
}

Request driveOrder(std::optional<double> speed_mps, std::optional<double> turn_radps,
                   std::optional<double> laser_pan_rad, std::optional<double> lateral_mps) {
  Request order;
  auto& drive = *order.mutable_drive();
  if (speed_mps) drive.set_speed_mps(*speed_mps);
  if (turn_radps) drive.set_turn_radps(*turn_radps);
  if (laser_pan_rad) drive.set_laser_pan_rad(static_cast<float>(*laser_pan_rad));
  if (lateral_mps) drive.set_lateral_mps(*lateral_mps);
  return order;
}

Request stopOrder(std::string_view why) {
  Request order;
  order.mutable_stop()->set_why(std::string(utf8Prefix(why, kMaxWhyBytes)));
  return order;
}

Request modeOrder(bool autonomous) {
  Request order;
  order.mutable_set_mode()->set_autonomous(autonomous);
  return order;
}

OrderType typeOf(const Request& order) {
  const auto* const row =
      std::find_if(kOrders.begin(), kOrders.end(), [&](const OrderRow& one) { return isOfRow(order, one); });
  if (row != kOrders.end()) return row->type;
  if (order.has_steer()) {
    throw WireError("a steering order of the unknown type " + std::to_string(order.steer().steering()) +
                    "; there are 1 to " + std::to_string(Request::Steering_MAX));
  }
  if (order.has_req_reading()) {
    throw WireError("a request for a sensor of the kind " + inQuotes(order.req_reading().kind()) + "; there are " +
                    namesOfReadings());
  }
  throw WireError("a message of a remote control without a known request; see doc/remote_control.md");
}

std::string_view whyOf(const Request& stop) { return utf8Prefix(stop.stop().why(), kMaxWhyBytes); }

Request mergeDrive(Request older, const Request& newer) {
  older.MergeFrom(newer);
  return older;
}

void checkText(std::string_view text, std::size_t max_bytes, const char* what) {
  if (text.size() > max_bytes) {
    throw WireError(std::string(what) + " of " + std::to_string(text.size()) + " bytes; the most is " +
                    std::to_string(max_bytes));
  }
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    throw WireError(std::string(what) + " with control characters");
  }
}

void validate(const Request& request) {
  switch (request.request_case()) {
    case Request::kInit:
      checkProtocol(request.init().protocol());
      return checkText(request.init().driver(), kMaxDriverBytes, "a driver's name");
    case Request::kDrive:
      checkFinite(request.drive().speed_mps(), "speed_mps");
      checkFinite(request.drive().turn_radps(), "turn_radps");
      checkFinite(request.drive().lateral_mps(), "lateral_mps");
      return checkFinite(request.drive().laser_pan_rad(), "laser_pan_rad");
    case Request::kStop:  // takes effect whatever the length of its reason
      return checkText(whyOf(request), kMaxWhyBytes, "a reason to stop");
    case Request::kReqAll:
      return;
    default:
      typeOf(request);
  }
}

void validate(const v1::RobotState& state) {
  if (!decode(state.activity())) {
    throw WireError("a robot with the unknown activity " + std::to_string(state.activity()));
  }
  if (!std::isfinite(state.speed_mps()) || !std::isfinite(state.turn_radps()) || !std::isfinite(state.lateral_mps())) {
    throw WireError("a robot whose command is not finite");
  }
  if (!std::isfinite(state.driven_m())) throw WireError("a robot whose driven distance is not finite");
}

v1::RobotState initialState() {
  v1::RobotState state;
  state.set_autonomous(true);
  state.set_activity(v1::ACTIVITY_ACTIVE);
  return state;
}

}  // namespace robosim
