#include "serving/new_arcos_connections.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include <sys/epoll.h>
#include <unistd.h>

namespace robosim {

NewArcosConnections::NewArcosConnections() : events_(epoll_create1(EPOLL_CLOEXEC)) {
  if (events_ < 0) {
    throw std::runtime_error(std::string("cannot serve ARCOS programs: ") + std::strerror(errno) +
                             "; raise the limit of open files (ulimit -n)");
  }
}

NewArcosConnections::~NewArcosConnections() { close(events_); }

void NewArcosConnections::add(const AcceptedConnection& accepted, std::unique_ptr<ArcosConnection> connection) {
  epoll_event event{};
  event.events = EPOLLIN | EPOLLRDHUP;
  event.data.u64 = accepted.number;
  epoll_ctl(events_, EPOLL_CTL_ADD, accepted.socket, &event);
  connections_[accepted.number] = {accepted.socket, std::move(connection)};
}

std::unique_ptr<ArcosConnection> NewArcosConnections::take(Number number) {
  auto entry = connections_.extract(number);
  if (entry.empty()) return nullptr;
  epoll_ctl(events_, EPOLL_CTL_DEL, entry.mapped().socket, nullptr);
  return std::move(entry.mapped().connection);
}

std::vector<NewArcosConnections::Number> NewArcosConnections::receive(ArcosSession::Clock::time_point now) {
  std::vector<Number> ended;
  std::array<epoll_event, kReadsAtOnce> ready;
  const int count = epoll_wait(events_, ready.data(), static_cast<int>(ready.size()), 0);
  for (int i = 0; i < count; ++i) {
    const Number number = ready[static_cast<std::size_t>(i)].data.u64;  // a copy, because epoll_event is packed
    const auto found = connections_.find(number);
    if (found == connections_.end()) continue;
    ArcosConnection& connection = *found->second.connection;
    connection.receive(now);
    if (!connection.endReason().empty()) ended.push_back(number);
  }
  return ended;
}

std::vector<NewArcosConnections::Number> NewArcosConnections::poll(ArcosSession::Clock::time_point now) {
  std::vector<Number> ended;
  for (auto& [number, entry] : connections_) {
    entry.connection->poll(now);
    if (!entry.connection->endReason().empty()) ended.push_back(number);
  }
  return ended;
}

}  // namespace robosim
