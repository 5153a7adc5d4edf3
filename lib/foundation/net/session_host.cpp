#include "net/session_host.h"

#include <utility>

#include "base/seconds.h"
#include "net/server_session.h"

namespace robosim {

void SessionHost::adopt(const std::shared_ptr<ServerSession>& session, std::function<void()> await_next) {
  session->await_next_ = std::move(await_next);
  session->position_ = others_.insert(others_.end(), session);
}

std::vector<std::shared_ptr<ServerSession>> SessionHost::calls() const {
  std::vector<std::shared_ptr<ServerSession>> calls(handshakes_.begin(), handshakes_.end());
  for (const auto& session : others_) {
    if (session->isEstablished()) calls.push_back(session);
  }
  return calls;
}

void SessionHost::checkSessions() {
  limited_log.reportSuppressed();
  audit.reportSuppressed();
  if (std::exchange(access_version_, access.refresh()) != access_version_) {
    for (const auto& session : calls()) {
      if (const auto status = session->permission(); !status.ok()) session->disconnect(status);
    }
  }
  while (!handshakes_.empty() && now() >= nextDeadline()) {
    ServerSession& session = *handshakes_.front();
    const auto ms = wholeMilliseconds(hello_deadline);
    session.disconnect(errorStatus(v1::ERROR_REASON_FIRST_MESSAGE_DEADLINE,
                                   "no " + std::string(session.rules_.first_message) + " within " + std::to_string(ms) +
                                       " ms of the call; send it at once, and call again"));
  }
}

SessionHost::Clock::time_point SessionHost::nextDeadline() const {
  return handshakes_.empty() ? Clock::time_point::max() : handshakes_.front()->since_ + hello_deadline;
}

void SessionHost::endSessions() {
  is_over = true;
  for (const auto& session : calls()) session->runEnds();
}

grpc::Status SessionHost::runIsOver() { return errorStatus(v1::ERROR_REASON_RUN_OVER, "the run is over"); }

std::string SessionHost::tokenSuffix(const Identity& client) const {
  return access.isOpen() ? "" : ", with the token " + client.name();
}

}  // namespace robosim
