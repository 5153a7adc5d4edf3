#include "net/remote_wire.h"

#include <algorithm>
#include <cmath>

#include "base/utf8.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

void checkFinite(double value, const char* name) {
  if (std::isfinite(value)) return;
  throw WireError(std::string("a drive command with a ") + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
}

struct SteeringType {
  v1::ControlRequest::Steering steering;
  RemoteType type;
};
constexpr SteeringType kSteeringTypes[] = {
    {v1::ControlRequest::STEERING_ACCELERATE, RemoteType::accelerate},
    {v1::ControlRequest::STEERING_DECELERATE, RemoteType::decelerate},
    {v1::ControlRequest::STEERING_TURN_LEFT, RemoteType::turn_left},
    {v1::ControlRequest::STEERING_TURN_RIGHT, RemoteType::turn_right},
};

v1::ControlRequest::Steering steeringOf(RemoteType type) {
  for (const auto& known : kSteeringTypes) {
    if (known.type == type) return known.steering;
  }
  return v1::ControlRequest::STEERING_UNSPECIFIED;
}

RemoteType typeOf(v1::ControlRequest::Steering steering) {
  for (const auto& known : kSteeringTypes) {
    if (known.steering == steering) return known.type;
  }
  throw WireError("a steering order of the unknown type " + std::to_string(steering) + "; there are 1 to " +
                  std::to_string(v1::ControlRequest::Steering_MAX));
}

RemoteOrder decodeInit(const v1::ControlRequest::Init& in) {
  checkProtocol(in.protocol());
  checkText(in.driver(), kMaxDriverBytes, "a driver's name");
  return {.type = RemoteType::init,
          .robot = in.robot(),
          .driver = in.driver(),
          .autonomous = in.autonomous(),
          .only_observe = in.only_observe()};
}

RemoteOrder decodeDrive(const v1::ControlRequest::Drive& in) {
  checkFinite(in.speed_mps(), "speed_mps");
  checkFinite(in.turn_radps(), "turn_radps");
  checkFinite(in.laser_pan_rad(), "laser_pan_rad");
  RemoteOrder order{.type = RemoteType::drive};
  if (in.has_speed_mps()) order.speed_mps = in.speed_mps();
  if (in.has_turn_radps()) order.turn_radps = in.turn_radps();
  if (in.has_laser_pan_rad()) order.laser_pan_rad = in.laser_pan_rad();
  return order;
}

}  // namespace

void checkText(const std::string& text, std::size_t max_bytes, const char* what) {
  if (text.size() > max_bytes) {
    throw WireError(std::string(what) + " of " + std::to_string(text.size()) + " bytes; the most is " +
                    std::to_string(max_bytes));
  }
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    throw WireError(std::string(what) + " with control characters");
  }
}

void encode(const RemoteOrder& order, v1::ControlRequest& out) {
  out.Clear();
  switch (order.type) {
    case RemoteType::init: {
      auto& init = *out.mutable_init();
      init.set_protocol(kProtocolVersion);
      init.set_robot(order.robot);
      init.set_driver(order.driver);
      init.set_autonomous(order.autonomous);
      init.set_only_observe(order.only_observe);
      break;
    }
    case RemoteType::set_mode:
      out.mutable_set_mode()->set_autonomous(order.autonomous);
      break;
    case RemoteType::accelerate:
    case RemoteType::decelerate:
    case RemoteType::turn_left:
    case RemoteType::turn_right:
      out.mutable_steer()->set_steering(steeringOf(order.type));
      break;
    case RemoteType::req_heat:
    case RemoteType::req_laser:
    case RemoteType::req_sonar:
      out.mutable_req_reading()->set_kind(requestedKind(order.type));
      break;
    case RemoteType::drive: {
      auto& drive = *out.mutable_drive();
      if (order.speed_mps) drive.set_speed_mps(*order.speed_mps);
      if (order.turn_radps) drive.set_turn_radps(*order.turn_radps);
      if (order.laser_pan_rad) drive.set_laser_pan_rad(*order.laser_pan_rad);
      break;
    }
    case RemoteType::stop:
      out.mutable_stop()->set_why(std::string(utf8Prefix(order.why, kMaxWhyBytes)));
      break;
    case RemoteType::alive:
      out.mutable_alive();
      break;
    case RemoteType::check_win:
      out.mutable_check_win();
      break;
    case RemoteType::req_all:
      out.mutable_req_all();
      break;
  }
}

RemoteOrder decode(const v1::ControlRequest& in) {
  using Request = v1::ControlRequest;
  switch (in.request_case()) {
    case Request::kInit:
      return decodeInit(in.init());
    case Request::kSetMode:
      return {.type = RemoteType::set_mode, .autonomous = in.set_mode().autonomous()};
    case Request::kSteer:
      return {.type = typeOf(in.steer().steering())};
    case Request::kDrive:
      return decodeDrive(in.drive());
    case Request::kStop: {
      // A stop takes effect whatever the length of its reason.
      const std::string why(utf8Prefix(in.stop().why(), kMaxWhyBytes));
      checkText(why, kMaxWhyBytes, "a reason to stop");
      return {.type = RemoteType::stop, .why = why};
    }
    case Request::kAlive:
      return {.type = RemoteType::alive};
    case Request::kCheckWin:
      return {.type = RemoteType::check_win};
    case Request::kReqReading: {
      const auto type = requestFor(in.req_reading().kind());
      if (!type) {
        throw WireError("a request for a sensor of the kind " + inQuotes(in.req_reading().kind()) +
                        "; there are 'heat', 'laser' and 'sonar'");
      }
      return {.type = *type};
    }
    case Request::kReqAll:
      return {.type = RemoteType::req_all};
    case Request::REQUEST_NOT_SET:
      break;
  }
  throw WireError("a message of a remote control without a known request; see doc/remote_control.md");
}

const char* requestedKind(RemoteType type) {
  switch (type) {
    case RemoteType::req_heat:
      return "heat";
    case RemoteType::req_laser:
      return "laser";
    case RemoteType::req_sonar:
      return "sonar";
    default:
      return nullptr;
  }
}

std::optional<RemoteType> requestFor(const std::string& kind) {
  for (const auto type : {RemoteType::req_heat, RemoteType::req_laser, RemoteType::req_sonar}) {
    if (kind == requestedKind(type)) return type;
  }
  return std::nullopt;
}

void encode(const RemoteState& state, v1::RobotState& out) {
  out.set_autonomous(state.autonomous);
  out.set_driver(state.driver);
  out.set_is_yours(state.is_yours);
  out.set_speed_mps(state.speed_mps);
  out.set_turn_radps(state.turn_radps);
  out.set_activity(encode(state.activity));
  out.set_why_stopped(state.why_stopped);
  out.set_winner(state.winner);
  out.set_win_refusals(state.win_refusals);
  out.set_stalled(state.stalled);
  out.set_stops(state.stops);
  if (state.driven_m) out.set_driven_m(*state.driven_m);
  out.set_is_stopping(state.is_stopping);
}

RemoteState decode(const v1::RobotState& in) {
  const auto activity = decode(in.activity());
  if (!activity) {
    throw WireError("a robot with the unknown activity " + std::to_string(in.activity()));
  }
  if (!std::isfinite(in.speed_mps()) || !std::isfinite(in.turn_radps())) {
    throw WireError("a robot whose command is not finite");
  }
  if (!std::isfinite(in.driven_m())) throw WireError("a robot whose driven distance is not finite");
  return {.autonomous = in.autonomous(),
          .driver = in.driver(),
          .is_yours = in.is_yours(),
          .speed_mps = in.speed_mps(),
          .turn_radps = in.turn_radps(),
          .activity = *activity,
          .why_stopped = in.why_stopped(),
          .winner = in.winner(),
          .win_refusals = in.win_refusals(),
          .stalled = in.stalled(),
          .stops = in.stops(),
          .driven_m = in.has_driven_m() ? std::optional(in.driven_m()) : std::nullopt,
          .is_stopping = in.is_stopping()};
}

}  // namespace robosim
