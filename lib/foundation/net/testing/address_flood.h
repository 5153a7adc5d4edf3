#pragma once
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {

/// Connections from 1,000 addresses of this machine, 127.1.0.1 to 127.1.3.250, to a port at 127.0.0.1: one after the
/// other is opened again and sends the same bytes, on a thread of its own, for this object's lifetime.
class AddressFlood {
 public:
  static constexpr std::size_t kAddresses = 1000;

  AddressFlood(int port, std::string bytes)
      : port_(port), bytes_(std::move(bytes)), sockets_(kAddresses, -1), thread_([this] { run(); }) {}
  ~AddressFlood() {
    is_over_ = true;
    thread_.join();
    for (const int socket : sockets_) close(socket);
  }
  AddressFlood(const AddressFlood&) = delete;
  AddressFlood& operator=(const AddressFlood&) = delete;

  /// Waits until each address has connected.
  void waitForAll() const { rounds_.wait(0); }

 private:
  void run() {
    while (!is_over_) {
      for (int& socket : sockets_) {
        close(socket);
        socket = connectFrom(static_cast<std::size_t>(&socket - sockets_.data()));
      }
      ++rounds_;
      rounds_.notify_all();
    }
  }
  static sockaddr_in addressOf(std::uint32_t host, int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(host);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
  }
  int connectFrom(std::size_t index) const {
    constexpr std::uint32_t kFirst = 0x7F010000, kPerNetwork = 250;
    const auto i = static_cast<std::uint32_t>(index);
    const sockaddr_in from = addressOf(kFirst + i / kPerNetwork * 256 + i % kPerNetwork + 1, 0);
    const sockaddr_in to = addressOf(INADDR_LOOPBACK, port_);
    const int client = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    // Over loopback it is connected afterwards, unless the server's queue is full.
    static_cast<void>(bind(client, reinterpret_cast<const sockaddr*>(&from), sizeof from));
    static_cast<void>(connect(client, reinterpret_cast<const sockaddr*>(&to), sizeof to));
    send(client, bytes_.data(), bytes_.size(), MSG_NOSIGNAL);
    return client;
  }

  const int port_;
  const std::string bytes_;
  std::vector<int> sockets_;
  std::atomic<bool> is_over_{false};
  std::atomic<int> rounds_{0};
  std::thread thread_;
};

}  // namespace robosim
