#include "net/tls.h"

#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/connect.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A socket that listens and never accepts: the system completes connections until the backlog is full, and then
/// ignores further ones.
class DeafListener {
 public:
  DeafListener() : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    own_.sin_family = AF_INET;
    own_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own_;
    if (bind(listener_, plain(), size) != 0 || listen(listener_, 0) != 0 ||
        getsockname(listener_, plain(), &size) != 0) {
      ADD_FAILURE() << "cannot listen";
    }
  }
  ~DeafListener() {
    for (const int socket : callers_) close(socket);
    close(listener_);
  }
  DeafListener(const DeafListener&) = delete;
  DeafListener& operator=(const DeafListener&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(ntohs(own_.sin_port)); }
  /// Connects until a connection is not completed.
  void fillBacklog() {
    constexpr int kMaxCallers = 64, kCompletedMs = 200;
    for (int i = 0; i < kMaxCallers; ++i) {
      callers_.push_back(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
      connect(callers_.back(), plain(), sizeof own_);
      pollfd connected{callers_.back(), POLLOUT, 0};
      if (poll(&connected, 1, kCompletedMs) == 0) return;
    }
    ADD_FAILURE() << "the backlog is never full";
  }

 private:
  sockaddr* plain() { return reinterpret_cast<sockaddr*>(&own_); }

  int listener_;
  sockaddr_in own_{};
  std::vector<int> callers_;
};

TEST(DiagnoseTls, TimesOutWhileConnecting) {
  DeafListener listener;
  listener.fillBacklog();
  EXPECT_EQ(diagnoseTls(listener.address(), "", 100ms), "");
}

TEST(DiagnoseTls, TimesOutDuringTheHandshake) {
  const DeafListener listener;
  EXPECT_EQ(diagnoseTls(listener.address(), "", 100ms), "the server has not responded within 100 ms");
}

TEST(ConnectionError, IsCreatedWithinTheConnectLimit) {
  DeafListener listener;
  listener.fillBacklog();
  ConnectOptions connect_options{.address = listener.address()};
  connect_options.tls = true;
  connect_options.connect_limit = 100ms;
  const ConnectionError error({grpc::StatusCode::UNAVAILABLE, "no connection"}, connect_options);
  EXPECT_EQ(std::string(error.what()).find("no environment answers at " + listener.address()), 0u) << error.what();
}

}  // namespace
}  // namespace robosim
