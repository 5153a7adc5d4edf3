#pragma once
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// After so long without a word each end of a connection asks whether the other's machine is still there, and after as
/// long again takes it for dead. (A process that has died is noticed at once, and one that stalls by the step
/// deadline.)
constexpr std::chrono::milliseconds kKeepalive{20'000};

/// Whom a client calls, and how.
struct DialOptions {
  std::string address = "127.0.0.1:3000";  ///< "host:port"
  bool tls = false;
  std::string trusted_pem{};  ///< with TLS, the certificates to trust; empty for the system's authorities
  std::string token{};        ///< shown with every call; empty for none
  bool insecure = false;  ///< show the token without TLS to other machines as well, where anyone on the way can read it
  std::chrono::milliseconds keepalive = kKeepalive;  ///< after so long without a word the other end is asked
};

/// A call came to no good end: what, where and the mend.
class ConnectionError : public std::runtime_error {
 public:
  ConnectionError(const grpc::Status& status, const DialOptions& dialled);
  grpc::StatusCode code() const { return code_; }
  /// Whether another call may fare better, with nothing mended: the connection broke, the caller was too late for a
  /// step, or its robots are still held by a connection of before.
  bool mayPass() const;

 private:
  grpc::StatusCode code_;
};

/// A connection to the environment; made when first used.
/// @throws ConfigError for a token that would cross the network in clear text.
std::shared_ptr<grpc::Channel> dial(const DialOptions& options);

/// Shows the token with a call: before the call is made.
void showToken(grpc::ClientContext& call, const DialOptions& options);

}  // namespace robosim
