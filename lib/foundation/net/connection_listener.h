#pragma once
#include <string>
#include <vector>

namespace robosim {

/// The listening sockets of one address. gRPC 1.51's own listener stops accepting for good once the process has run out
/// of descriptors. This class reports that case, so that its caller (ConnectionAcceptor) can try again, and reserves
/// descriptors for files and for the program's own connections: a connection beyond the limit is closed at once.
class ConnectionListener {
 public:
  /// Maximum number of descriptors that the process uses, for connections and everything else; lower where the system's
  /// limit is lower (`ulimit -Hn`).
  static constexpr int kMaxDescriptors = 4096;
  /// Number of descriptors that are never used for a connection.
  static constexpr int kReservedDescriptors = 32;

  /// Binds to "host:port" and listens; port 0 lets the system choose. A host with several addresses is bound at each.
  /// @throws std::runtime_error with the address, the cause and how to fix it
  /// @param option command-line option of the address, for the error text
  ConnectionListener(const std::string& address, const std::string& option);
  ~ConnectionListener();  ///< closes the sockets; accepted connections stay
  ConnectionListener(const ConnectionListener&) = delete;
  ConnectionListener& operator=(const ConnectionListener&) = delete;

  int port() const { return port_; }
  const std::string& address() const { return address_; }
  const std::vector<int>& sockets() const { return listeners_; }
  /// Number of descriptors that the process may use, kReservedDescriptors of them for no connection.
  static int descriptors();
  /// Whether a descriptor is one of those that are used for no connection. The system assigns the lowest free number,
  /// so that a high number implies that nearly as many are in use.
  static bool isReserved(int descriptor) { return descriptor >= descriptors() - kReservedDescriptors; }

  enum class Accepted { connection, none, later };
  /// Accepts a connection of one of the sockets, without waiting.
  /// @param connection receives a non-blocking socket
  /// @return later when there may be a connection that cannot be accepted now
  Accepted accept(int listener, int& connection) const;

 private:
  std::string address_;
  std::vector<int> listeners_;
  int port_ = 0;
};

}  // namespace robosim
