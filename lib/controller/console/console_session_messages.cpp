// Handlers of the pages' messages. Each is called only after the message was authorised.
#include <algorithm>
#include <utility>
#include <variant>

#include "console/console_session.h"

namespace robosim {

void ConsoleSession::handle(Page& page, const PageMessage& message, Time now) {
  if (const auto* order = std::get_if<OrderType>(&message.type)) return giveOrder(page, message, *order, now);
  switch (std::get<ConsoleRequest>(message.type)) {
    case ConsoleRequest::hello:
      return handleHello(page, message);
    case ConsoleRequest::ack:
      return acknowledge(page, message.number, now);
    case ConsoleRequest::ping:
      return reply(page, pongJson(message.number));
    case ConsoleRequest::live:
      return page.outbox.subscribeSensors(message.on);
    case ConsoleRequest::map:
      return subscribeMap(page, message.on);
    case ConsoleRequest::take:
      return take(page);
    case ConsoleRequest::release:
      return release(page, page.name + " has released control");
    case ConsoleRequest::switch_primary:
      return switchPrimary(page, message.robot);
    case ConsoleRequest::play_again:
      return playAgain(page);
    case ConsoleRequest::record:
      return record(page, message.on);
    case ConsoleRequest::join:
      return join(page, message, now);
    case ConsoleRequest::leave:
      if (rounds_) leaveRounds(page);
      return;
    case ConsoleRequest::start:
      if (rounds_) rounds_->start(page.id, now);
      return;
    case ConsoleRequest::skip:
      return skipRound(page);
  }
}

/// An order to the primary robot. The answer to a request of a reading is sent to every page.
void ConsoleSession::giveOrder(Page& page, const PageMessage& message, OrderType type, Time now) {
  if (rounds_ && type == OrderType::set_mode && message.on) return;  // the visitor drives, not the robot's controller
  if (type == OrderType::stop && message.why.empty()) may_explore_ = false;  // the button of the page
  if (type == OrderType::drive) may_explore_ = true;
  if (type == OrderType::check_win) audit(page, "check_win " + primary());
  if (type == OrderType::set_mode) audit(page, (message.on ? "autonomous on " : "autonomous off ") + primary());
  for (auto& order : orders_.add(orderOf(page, message, type), now)) act(SendOrder{std::move(order)});
}

v1::ControlRequest ConsoleSession::orderOf(const Page& page, const PageMessage& message, OrderType type) const {
  if (type == OrderType::set_mode) return modeOrder(message.on);
  if (type == OrderType::stop) return stopOrder(message.why.empty() ? "" : page.name + "'s page " + message.why);
  if (type != OrderType::drive) return makeOrder(type);
  const MotionLimits& limits = feed_.primary.info->type->limits;
  const auto scaled = [](std::optional<double> part, double max) { return part ? std::optional(*part * max) : part; };
  return driveOrder(scaled(message.speed, limits.speed_max_mps), scaled(message.turn, limits.turn_max_radps),
                    message.pan_rad);
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
  page.name = message.name.empty() ? pageName(page.id) : message.name;
  if (!std::exchange(page.is_admitted, true)) audit(page, "join");
  reply(page, welcomeJson(page.id, mayOperate(access_, page.client), rounds_.has_value()));
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

void ConsoleSession::take(Page& page) {
  if (rounds_) {
    reply(page, noteJson("Visitors drive in turn: press Start to get a place.", false));
    return;
  }
  if (lock_.holder != 0 && lock_.holder != page.id) {
    reply(page, noteJson(lock_.name + " drives; you may watch.", false));
    return;
  }
  giveControl(page);
}

/// @param robot empty for the next robot of the queue that is fit and that the page's token permits
void ConsoleSession::switchPrimary(Page& page, const std::string& robot) {
  if (rounds_) return;  // the round is for this robot
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
  if (rounds_ || !run_.may_restart || run_.is_restarting) return;
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
  const bool needs_lock = rowOf(message.type).page == PageMessageRow::Page::holds_lock;
  reply(page, noteJson(why, needs_lock));
  if (needs_lock && !mayDrive(access_, page.client, primary())) release(page, page.name + "'s token was refused");
}

}  // namespace robosim
