#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace robosim {

/// Disconnects peers that send HTTP/2 frames faster than gRPC 1.51 handles them, such as streams that are opened and
/// reset at once (HTTP/2 rapid reset, CVE-2023-44487). gRPC does not limit these: the thread that waits for events does
/// not return from gRPC while they arrive, and each stream uses 13 kB until it does. Messages are limited by HTTP/2's
/// flow control.
///
/// A thread checks every kPeriod whether a wait in gRPC has taken more than kBusyLimit of processor time. If so, the
/// connection that has sent the most during that wait, and more than kMinBytes, is disconnected; one with an Exemption
/// only if it has sent more than kMaxExemptBytes. A flood whose waits end, or that other threads of gRPC handle, is
/// detected by its bytes: a connection without an exemption is disconnected when it has sent kMaxUnansweredBytes more
/// than it has received. (A client without an exemption receives more bytes for each request than it sends.) No
/// connection from its address is accepted for kBan; from an address that also has exempt connections (a proxy, or
/// several programs on one machine) one per kThrottle. The guard is global, as the descriptors of the process are.
/// Thread-safe.
namespace flood_guard {

constexpr std::chrono::milliseconds kPeriod{10};
constexpr std::chrono::milliseconds kBusyLimit{50};
constexpr std::chrono::seconds kBan{30};
constexpr std::chrono::seconds kThrottle{1};
/// A connection that has sent less than this during the wait is not the cause [bytes]. A process of 100 robots sends
/// 40 kB before the first of them is authorized.
constexpr std::uint64_t kMinBytes = 128 * 1024;
/// More than a client sends that waits for responses: robots and geometry workers respond to a step once.
constexpr std::uint64_t kMaxExemptBytes = 16 * 1024 * 1024;
constexpr std::uint64_t kMaxUnansweredBytes = 512 * 1024;
constexpr int kPeriodsPerCount = 25;  ///< interval at which the bytes of all connections are counted

/// Monitors an accepted connection until it is closed.
/// @return false when it must be closed because its address is banned or throttled
bool admit(int connection);

/// Responses that are on their way when an exemption ends, such as those of all robots of a process at the end of a
/// run, are still exempt.
constexpr std::chrono::seconds kExemptionLinger{5};

/// Marks, for its lifetime and kExemptionLinger after it, the connection of a client that may send more than it
/// receives: a client that drives robots, computes geometry, or loads a world, with a valid token if tokens are
/// required.
class Exemption {
 public:
  Exemption() = default;
  /// @param peer of the connection, as returned by grpc::ServerContext::peer()
  explicit Exemption(std::string peer);
  ~Exemption();
  Exemption(Exemption&& other) noexcept : peer_(std::exchange(other.peer_, {})) {}
  Exemption& operator=(Exemption&& other) noexcept {
    std::swap(peer_, other.peer_);
    return *this;
  }

 private:
  std::string peer_;  ///< empty for none
};

/// Marks, for its lifetime, that the calling thread waits in gRPC.
class Wait {
 public:
  Wait();
  ~Wait();
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;
};

}  // namespace flood_guard
}  // namespace robosim
