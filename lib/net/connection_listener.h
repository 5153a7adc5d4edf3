#pragma once
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace robosim {

/// The listening sockets of one address, and the thread that accepts their connections. gRPC 1.51's own listener stops
/// accepting for good once the process has run out of descriptors. This class retries after a pause, and reserves
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

  /// Starts the accepting thread.
  /// @param take receives the listening and the accepted socket, and owns the latter; called from that thread
  void start(std::function<void(int listener, int connection)> take);

 private:
  void acceptAll();
  bool acceptFrom(int listener);

  std::string address_;
  std::vector<int> listeners_;
  int port_ = 0;
  int end_ = -1;  ///< an eventfd that stops the thread
  int descriptors_ = kMaxDescriptors;
  std::function<void(int, int)> take_;
  std::thread thread_;
};

}  // namespace robosim
