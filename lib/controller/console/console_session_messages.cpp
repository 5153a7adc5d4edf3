// Handlers of the pages' messages. Each is called only after the message was authorised.
#include <algorithm>
#include <utility>

#include "console/console_session.h"

namespace robosim {
namespace {

using Type = PageMessage::Type;

/// The order of the remote control protocol for a message that consists of its type only.
RemoteType orderTypeOf(Type type) {
  switch (type) {
    case Type::accelerate:
      return RemoteType::accelerate;
    case Type::decelerate:
      return RemoteType::decelerate;
    case Type::turn_left:
      return RemoteType::turn_left;
    case Type::turn_right:
      return RemoteType::turn_right;
    default:
      return RemoteType::alive;
  }
}

}  // namespace

void ConsoleSession::handle(Page& page, const PageMessage& message, Time now) {
  switch (message.type) {
    case Type::hello:
      return handleHello(page, message);
    case Type::ack:
      return acknowledge(page, message.number, now);
    case Type::ping:
      return reply(page, pongJson(message.number));
    case Type::live:
      return page.outbox.subscribeSensors(message.on);
    case Type::map:
      return subscribeMap(page, message.on);
    case Type::req_heat:
      return requestReading(RemoteType::req_heat);
    case Type::req_laser:
      return requestReading(RemoteType::req_laser);
    case Type::req_sonar:
      return requestReading(RemoteType::req_sonar);
    case Type::take:
      return take(page);
    case Type::release:
      return release(page, page.name + " has released control");
    case Type::drive:
      return drive(message, now);
    case Type::accelerate:
    case Type::decelerate:
    case Type::turn_left:
    case Type::turn_right:
    case Type::alive:
      return steer({.type = orderTypeOf(message.type)}, now);
    case Type::stop:
      return steer({.type = RemoteType::stop, .why = message.why.empty() ? "" : page.name + "'s page " + message.why},
                   now);
    case Type::check_win:
      return checkWin(page, now);
    case Type::autonomous:
      return setAutonomous(page, message.on);
    case Type::switch_primary:
      return switchPrimary(page, message.robot);
    case Type::play_again:
      return playAgain(page);
    case Type::record:
      return record(page, message.on);
  }
}

/// Authenticates a page. A later hello may change the page's name, and with a token its rights: whatever the new token
/// does not permit ends, orders that wait included.
void ConsoleSession::handleHello(Page& page, const PageMessage& message) {
  std::optional<std::string_view> token;
  if (!message.token.empty()) token = message.token;
  if (!page.is_admitted || token) {
    const auto [status, client] = access_.authenticate(token, page.peer);
    if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) {
      disconnect(page, status.error_message());  // the page reconnects by itself
      return;
    }
    page.client = client;
    if (!mayDrive(access_, client, primary())) release(page, page.name + " has presented another token");
    if (page.outbox.subscription().map && !mayLook(access_, client)) subscribeMap(page, false);
    if (!status.ok() || !mayJoin(access_, client)) {
      return reject(page, !token         ? "This console requires a token."
                          : !status.ok() ? "The token is unknown or has expired."
                                         : "The token permits neither driving nor watching.");
    }
  }
  page.name = message.name.empty() ? "Page " + std::to_string(page.id) : message.name;
  if (!std::exchange(page.is_admitted, true)) audit(page, "join");
  reply(page, welcomeJson(page.id, mayOperate(access_, page.client)));
  publishTeam();
}

void ConsoleSession::acknowledge(Page& page, std::uint64_t number, Time now) {
  if (!page.outbox.acknowledge(number, now)) throw WireError("an ack for an update that was not sent");
  act(WakePage{page.id});
}

void ConsoleSession::subscribeMap(Page& page, bool on) {
  page.outbox.subscribeMap(on);
  watchMap();
}

/// The answer is sent to every page.
void ConsoleSession::requestReading(RemoteType type) { act(SendOrder{{.type = type}}); }

void ConsoleSession::take(Page& page) {
  if (lock_.holder != 0 && lock_.holder != page.id) {
    reply(page, noteJson(lock_.name + " drives; you may watch.", false));
    return;
  }
  if (lock_.holder != page.id) audit(page, "take " + primary());
  lock_.holder = page.id;
  lock_.name = page.name;
  orders_.clear();  // the robot stands for the new driver, even if the driver is the same
  act(SetDriver{page.name});
  publishTeam();
}

void ConsoleSession::drive(const PageMessage& message, Time now) {
  const MotionLimits& limits = feed_.primary.info->limits;
  RemoteOrder order{.type = RemoteType::drive};
  if (message.speed) order.speed_mps = *message.speed * limits.speed_max_mps;
  if (message.turn) order.turn_radps = *message.turn * limits.turn_max_radps;
  if (message.pan_rad) order.laser_pan_rad = static_cast<float>(*message.pan_rad);
  steer(order, now);
}

void ConsoleSession::steer(const RemoteOrder& order, Time now) {
  for (auto& next : orders_.add(order, now)) act(SendOrder{std::move(next)});
}

void ConsoleSession::checkWin(Page& page, Time now) {
  audit(page, "check_win " + primary());
  steer({.type = RemoteType::check_win}, now);
}

void ConsoleSession::setAutonomous(Page& page, bool autonomous) {
  audit(page, (autonomous ? "autonomous on " : "autonomous off ") + primary());
  orders_.clear();
  act(SetAutonomous{autonomous});
}

/// @param robot empty for the next robot of the queue that is fit and that the page's token permits
void ConsoleSession::switchPrimary(Page& page, const std::string& robot) {
  if (robots_.empty() || robot == primary()) return;
  const auto is_target = [&](const TeamRobot& other) {
    return other.isFit() && (robot.empty() ? mayDrive(access_, page.client, other.name) : other.name == robot);
  };
  const auto target = std::find_if(robots_.begin() + 1, robots_.end(), is_target);
  if (target == robots_.end()) {
    reply(page, noteJson(robot.empty() ? "No other robot can be driven now." : robot + " cannot be driven now.", true));
    return;
  }
  orders_.clear();
  pending_switch_ = {page.id, target->name};
  act(SwitchPrimary{target->name});
}

void ConsoleSession::playAgain(Page& page) {
  if (!run_.may_restart || run_.is_restarting) return;
  audit(page, "play again");
  act(RestartRun{});
}

void ConsoleSession::record(Page& page, bool on) {
  const RecordingView& recording = run_.recording;
  if (!recording.may_change || recording.is_changing || on == (recording.state == RecordingView::State::on)) return;
  audit(page, on ? "record on" : "record off");
  act(RecordRun{on});
}

/// Informs a page that its token does not permit a message, and releases the control lock if the token no longer
/// permits driving.
void ConsoleSession::deny(Page& page, const PageMessage& message, const std::string& why) {
  const bool needs_lock = ruleOf(message.type).page == MessageRule::Page::holds_lock;
  reply(page, noteJson(why, needs_lock));
  if (needs_lock && !mayDrive(access_, page.client, primary())) release(page, page.name + "'s token was refused");
}

}  // namespace robosim
