#pragma once
#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace robosim {

/// A TCP proxy to a local port that can cut the connection, or flip a bit, at any byte. Further connections are
/// forwarded too.
class FaultProxy {
 public:
  explicit FaultProxy(int port);
  ~FaultProxy();
  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(own_port_); }
  /// Cuts the current connection after `bytes` more bytes from the client.
  void cutAfter(int bytes) { from_client_.cut_after = bytes; }
  /// The same, after `bytes` more bytes to the client.
  void cutRepliesAfter(int bytes) { to_client_.cut_after = bytes; }
  /// Flips the lowest bit of the byte after `bytes` more bytes from the client, or to it.
  ///@{
  void flipBitAfter(int bytes) { from_client_.flip_after = bytes; }
  void flipReplyBitAfter(int bytes) { to_client_.flip_after = bytes; }
  ///@}
  /// Stops forwarding without closing, as when a machine loses power.
  void stopForwarding() { is_silent_ = true; }

  /// Faults to apply to one direction.
  struct Faults {
    std::atomic<int> cut_after{-1};   ///< bytes; below 0: never
    std::atomic<int> flip_after{-1};  ///< bytes; below 0: never
  };

 private:
  void acceptConnections();
  void forwardConnection(int client);

  int port_, own_port_ = 0, listener_ = -1;
  Faults from_client_, to_client_;
  std::atomic<bool> is_silent_{false}, is_ending_{false};
  std::thread thread_;
};

}  // namespace robosim
