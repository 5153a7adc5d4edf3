#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "net/peer_address.h"

namespace robosim {

/// Limits what the connections within gRPC 1.51 cost. gRPC does not limit HTTP/2 frames that carry no message, such as
/// streams that are opened and reset at once (HTTP/2 rapid reset, CVE-2023-44487): the thread that waits for events
/// does not return from gRPC while they arrive. Therefore a connection is passed to gRPC after its first authorised
/// call (ConnectionGate), and at most kMaxUnauthorised without one.
///
/// A thread checks every kPeriod whether a wait in gRPC has taken more than kBusyLimit of processor time. If so, the
/// connection that has sent the most during that wait, and more than kMinBytes, is disconnected; one with an Exemption
/// only if it has sent more than kMaxExemptBytes. A flood whose waits end, or that other threads of gRPC handle, is
/// detected by its bytes: a connection without an exemption is disconnected when it has sent kMaxUnansweredBytes more
/// than it has received (a client without an exemption receives more bytes for each request than it sends), and one
/// without an authorised call or exemption after kMinBytes or kMaxRefusedCalls.
///
/// Connections that end without an authorised call cost as well: more than kMaxFailures in a second are a flood.
///
/// After each flood an alarm lasts for kAlarm: it disconnects the other connections without an authorised call, no
/// further ones are passed to gRPC, and the network of the flood (PeerAddress::network()) is banned: gates handle its
/// new connections last. The guard is global, as the descriptors of the process are. Thread-safe.
namespace flood_guard {

constexpr std::chrono::milliseconds kPeriod{10};
constexpr std::chrono::milliseconds kBusyLimit{50};
constexpr std::chrono::seconds kAlarm{30};
/// A connection that has sent less than this during the wait is not the cause [bytes]. A process of 100 robots sends
/// 40 kB before the first of them is authorized.
constexpr std::uint64_t kMinBytes = 128 * 1024;
/// More than a client sends that waits for responses: robots and geometry workers respond to a step once.
constexpr std::uint64_t kMaxExemptBytes = 16 * 1024 * 1024;
constexpr std::uint64_t kMaxUnansweredBytes = 512 * 1024;
constexpr int kPeriodsPerCount = 25;  ///< interval at which the bytes of all connections are counted
constexpr std::size_t kMaxUnauthorised = 8;
constexpr int kMaxRefusedCalls = 256;
constexpr int kMaxFailures = 32;  ///< of connections in a second

/// Monitors a connection that is passed to gRPC until it is closed.
void admit(int connection, bool is_authorised);
/// Number of admitted connections without an authorised call.
std::size_t unauthorised();
/// A call of a connection was authorised, or refused. @param peer as returned by peerOf()
void noteAuthorised(const std::string& peer);
void noteRefused(const std::string& peer);

/// A gate has received a flood. @param what the peer does, for the log
void reportFlood(const PeerAddress& peer, std::string_view what);
/// Starts an alarm that no single network has caused.
void raiseAlarm(const std::string& why);
bool isAlarmed();
bool isBanned(const std::string& network);
/// Ends the alarm and the bans, for tests.
void endAlarm();

/// Responses that are on their way when an exemption ends, such as those of all robots of a process at the end of a
/// run, are still exempt.
constexpr std::chrono::seconds kExemptionLinger{5};

/// Marks, for its lifetime and kExemptionLinger after it, the connection of a client that may send more than it
/// receives: a client that drives robots, computes geometry, or loads a world, with a valid token if tokens are
/// required.
class Exemption {
 public:
  Exemption() = default;
  /// @param peer of the connection, as returned by peerOf()
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
