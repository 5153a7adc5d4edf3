#include "net/server_session.h"

#include <utility>

#include "net/error_status.h"

namespace robosim {

ServerSession::ServerSession(SessionHost& host, const SessionRules& rules)
    : host_(host), rules_(rules), registration_(*host.queue_server) {}

void ServerSession::onCalled(bool ok) {
  if (!ok) {  // the server is shutting down
    release();
    return;
  }
  startOperation();  // completed by done_
  endCallOnException([&] {
    peer_ = peerOf(context_);
    since_ = host_.now();
    state_ = State::awaiting_first_message;
    host_.handshakes_.splice(host_.handshakes_.end(), host_.others_, position_);
    std::exchange(await_next_, nullptr)();
    authorize();
    begun();
  });
}

void ServerSession::authorize() {
  host_.access.refresh();  // checkSessions() may have been called long ago
  auto [status, client] = host_.access.authenticate(context_);
  client_ = std::move(client);
  if (!status.ok()) {
    flood_guard::noteRefused(peer_);
  } else if (!host_.access.isOpen()) {
    flood_guard::noteAuthorised(peer_);
  }
  if (status.ok()) status = permission();
  if (status.ok() && host_.is_over) status = SessionHost::runIsOver();
  if (status.ok()) status = admit();
  if (!status.ok()) {
    disconnect(status);
  } else if (rules_.may_send_more) {
    exemption_ = flood_guard::Exemption(peer_);
  }
}

bool ServerSession::mayReceive() {
  // Tokens may have changed since the call.
  if (state_ == State::awaiting_first_message) {
    if (const auto status = permission(); !status.ok()) disconnect(status);
  }
  return state_ != State::gone;
}

void ServerSession::establish() {
  state_ = State::established;
  flood_guard::noteAuthorised(peer_);
  host_.others_.splice(host_.others_.end(), host_.handshakes_, position_);
}

void ServerSession::disconnect(const grpc::Status& status) {
  if (isGone()) return;
  if (isEstablished() && rules_.reports_each) {
    host_.log(logName() + ": disconnected: " + status.error_message());
  } else {
    host_.logRefusal(rules_.log_kind,
                     logName() + ": " + std::string(rules_.refused_word) + ": " + status.error_message());
  }
  close(status);
}

void ServerSession::close(const grpc::Status& status) {
  if (isGone()) return;
  leave();
  end(status);
}

void ServerSession::hasLeft() {
  if (rules_.reports_each) host_.log(logName() + ": has left");
}

void ServerSession::leave() {
  exemption_ = {};
  const State before = std::exchange(state_, State::gone);
  if (before == State::awaiting_first_message) {
    host_.others_.splice(host_.others_.end(), host_.handshakes_, position_);
  } else if (before == State::established) {
    logException([this] { left(); });  // the call ends in any case
  }
}

void ServerSession::onDone(bool /*ok*/) {
  is_cancelled_ = context_.IsCancelled();
  if (is_cancelled_) end(grpc::Status::CANCELLED);
}

void ServerSession::completeOperation() {
  if (--pending_ > 0) return;
  if (isEstablished()) logException([this] { hasLeft(); });
  if (!isGone()) leave();
  release();
}

void ServerSession::writeException(const char* what) {
  host_.logRefusal("internal errors", logName() + ": internal error: " + what);
}

void ServerSession::endAfterException() {
  close(errorStatus(v1::ERROR_REASON_INTERNAL,
                    "an internal error of the server has ended this call; the server's log states the cause"));
}

void ServerSession::release() {
  const auto last = *position_;  // possibly the last reference
  host_.others_.erase(position_);
}

}  // namespace robosim
