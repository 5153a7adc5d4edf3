#include "net/connection_acceptor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <sys/epoll.h>
#include <unistd.h>

namespace robosim {
namespace {

/// At most half of the descriptors that connections may use, so that those that are admitted find some.
std::size_t limitByDescriptors(std::size_t max) {
  const int available = ConnectionListener::descriptors() - ConnectionListener::kReservedDescriptors;
  return std::min(max, static_cast<std::size_t>(std::max(2, available)) / 2);
}

std::string firstAddress(const std::vector<std::shared_ptr<const ConnectionListener>>& listeners) {
  return listeners.empty() ? "" : listeners.front()->address();
}

}  // namespace

ConnectionAcceptor::ConnectionAcceptor(std::vector<std::shared_ptr<const ConnectionListener>> listeners,
                                       Options options)
    : listeners_(std::move(listeners)),
      options_(std::move(options)),
      pending_({.address = firstAddress(listeners_),
                .kind = options_.pending,
                .max = limitByDescriptors(options_.max_pending)},
               options_.close),
      events_(epoll_create1(EPOLL_CLOEXEC)) {
  if (events_ < 0) {
    throw std::runtime_error("cannot listen on " + firstAddress(listeners_) + ": " + std::strerror(errno) +
                             "; raise the limit of open files (ulimit -n)");
  }
  for (std::size_t port = 0; port < listeners_.size(); ++port) {
    for (const int listener : listeners_[port]->sockets()) {
      epoll_event event{};
      event.events = EPOLLIN;
      event.data.u64 = sockets_.size();
      epoll_ctl(events_, EPOLL_CTL_ADD, listener, &event);
      sockets_.push_back({port, listener});
    }
  }
}

ConnectionAcceptor::~ConnectionAcceptor() { close(events_); }

bool ConnectionAcceptor::accept(std::size_t most) {
  std::array<epoll_event, 64> ready;
  while (most > 0) {
    const int count = epoll_wait(events_, ready.data(), static_cast<int>(std::min(most, ready.size())), 0);
    if (count <= 0) return true;
    for (int i = 0; i < count; ++i) {
      const std::uint64_t index = ready[static_cast<std::size_t>(i)].data.u64;  // a copy, because epoll_event is packed
      const Socket& socket = sockets_[index];
      int connection = -1;
      switch (listeners_[socket.port]->accept(socket.listener, connection)) {
        case ConnectionListener::Accepted::later:
          pending_.closeOne();  // frees a descriptor
          return false;
        case ConnectionListener::Accepted::none:
          break;
        case ConnectionListener::Accepted::connection:
          add(socket, connection);
          break;
      }
      --most;  // one that was closed at once has cost as much
    }
  }
  return true;
}

void ConnectionAcceptor::add(const Socket& socket, int connection) {
  auto peer = PeerAddress::of(connection);
  const auto number = peer ? pending_.add(*peer) : std::nullopt;
  if (!number) {
    close(connection);
    return;
  }
  if (options_.take({*number, socket.port, socket.listener, connection, *std::move(peer)})) return;
  pending_.remove(*number);
  close(connection);
}

}  // namespace robosim
