#include "net/remote_wire.h"

#include <algorithm>
#include <cmath>

#include "base/utf8.h"

namespace robosim {
namespace {

static_assert(static_cast<int>(RemoteType::init) == wire::INIT &&
              static_cast<int>(RemoteType::req_sonar) == wire::REQ_SONAR &&
              static_cast<int>(RemoteType::req_all) == wire::REQ_ALL);

void checkFinite(double value, const char* name) {
  if (std::isfinite(value)) return;
  throw WireError(std::string("a drive command with a ") + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
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

void encode(const RemoteOrder& order, wire::ControlRequest& out) {
  out.Clear();
  out.set_type(static_cast<wire::RemoteType>(order.type));
  if (order.type == RemoteType::init) out.set_protocol(kProtocolVersion);
  out.set_robot(order.robot);
  out.set_driver(order.driver);
  out.set_autonomous(order.autonomous);
  out.set_only_watch(order.only_watch);
  out.set_why(std::string(utf8Prefix(order.why, kMaxWhyBytes)));
  if (order.speed_mps) out.set_speed_mps(*order.speed_mps);
  if (order.turn_radps) out.set_turn_radps(*order.turn_radps);
  if (order.laser_pan_rad) out.set_laser_pan_rad(*order.laser_pan_rad);
}

RemoteOrder decode(const wire::ControlRequest& in) {
  if (!wire::RemoteType_IsValid(in.type())) {
    throw WireError("a message of the type " + std::to_string(in.type()) + "; there are 0 (INIT) to " +
                    std::to_string(wire::RemoteType_MAX) + " (REQ_ALL)");
  }
  RemoteOrder order;
  order.type = static_cast<RemoteType>(in.type());
  if (order.type == RemoteType::init) checkProtocol(in.protocol());
  checkText(in.driver(), kMaxDriverBytes, "a driver's name");
  // A stop takes effect whatever the length of its reason.
  const std::string why(utf8Prefix(in.why(), kMaxWhyBytes));
  checkText(why, kMaxWhyBytes, "a reason to stop");
  order.robot = in.robot();
  order.driver = in.driver();
  order.autonomous = in.autonomous();
  order.only_watch = in.only_watch();
  order.why = why;
  checkFinite(in.speed_mps(), "speed_mps");
  checkFinite(in.turn_radps(), "turn_radps");
  checkFinite(in.laser_pan_rad(), "laser_pan_rad");
  if (in.has_speed_mps()) order.speed_mps = in.speed_mps();
  if (in.has_turn_radps()) order.turn_radps = in.turn_radps();
  if (in.has_laser_pan_rad()) order.laser_pan_rad = in.laser_pan_rad();
  return order;
}

void encode(const RemoteState& state, wire::RemoteState& out) {
  out.set_autonomous(state.autonomous);
  out.set_driver(state.driver);
  out.set_is_yours(state.is_yours);
  out.set_speed_mps(state.speed_mps);
  out.set_turn_radps(state.turn_radps);
  out.set_activity(static_cast<wire::Activity>(state.activity));
  out.set_why_stopped(state.why_stopped);
  out.set_winner(state.winner);
  out.set_win_refusals(state.win_refusals);
}

RemoteState decode(const wire::RemoteState& in) {
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("a robot with the unknown activity " + std::to_string(in.activity()));
  }
  if (!std::isfinite(in.speed_mps()) || !std::isfinite(in.turn_radps())) {
    throw WireError("a robot whose command is not finite");
  }
  return {in.autonomous(),  in.driver(),     in.is_yours(),
          in.speed_mps(),   in.turn_radps(), static_cast<Activity>(in.activity()),
          in.why_stopped(), in.winner(),     in.win_refusals()};
}

}  // namespace robosim
