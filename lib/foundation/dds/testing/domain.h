#pragma once
#include <chrono>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace robosim::dds {

/// A domain for the tests of this process. Each process has another one, so that tests in parallel do not meet. Ports
/// of domains above 100 are also used by the system.
inline int testDomain() {
  constexpr int kDomains = 100;
  static const int domain = [] {
    const int lock = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    for (int i = 0; i < kDomains; ++i) {
      const int candidate = (getpid() + i) % kDomains + 1;
      // The abstract name belongs to the network, as the domain does, and is free again when the process ends.
      const std::string name = '\0' + ("robosim test domain " + std::to_string(candidate));
      sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
      std::memcpy(address.sun_path, name.data(), name.size());
      const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
      if (bind(lock, reinterpret_cast<const sockaddr*>(&address), size) == 0) return candidate;
    }
    throw std::runtime_error("all domains are used by other tests");
  }();
  return domain;
}

/// Waits for what other threads do, for up to 5 minutes: longer than on any slow machine. @return whether it is so
template <typename Condition>
bool eventually(const Condition& is_so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  while (!is_so()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace robosim::dds
