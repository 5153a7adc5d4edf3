#pragma once
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include <grpcpp/grpcpp.h>

#include "net/error_status.h"

namespace robosim {

/// HTTP/2 keepalive interval: after this time without data each side sends a ping, and closes the connection when no
/// reply arrives within the same time again. (The end of a process is detected at once, a stalled one by the step
/// deadline.)
constexpr std::chrono::milliseconds kKeepalive{20'000};

/// Address and credentials for a client's connection.
struct ConnectOptions {
  std::string address = "127.0.0.1:3000";  ///< "host:port"
  bool tls = false;
  std::string trusted_pem{};                ///< with TLS, the trusted certificates; empty for the system's authorities
  std::string token{};                      ///< sent with every call; empty for none
  bool may_send_token_unencrypted = false;  ///< also to other machines without TLS, where it can be read in transit
  std::chrono::milliseconds keepalive = kKeepalive;  ///< interval of HTTP/2 keepalive pings
  /// Timeout for a TCP connection, and for the diagnosis of a TLS failure. At least 100 ms.
  std::chrono::milliseconds connect_limit{5000};
  bool shares_connections = true;            ///< uses connections of other channels of this process
  std::shared_ptr<grpc::Channel> channel{};  ///< to be used by connect(); null: a new one
};

/// A failed call; the message has the address, the cause and how to fix it.
class ConnectionError : public std::runtime_error {
 public:
  ConnectionError(const grpc::Status& status, const ConnectOptions& connect_options);
  grpc::StatusCode code() const { return code_; }
  /// Reason stated by the server; ERROR_REASON_UNSPECIFIED if the error is of gRPC or of this program.
  v1::ErrorReason reason() const { return reason_; }
  /// Whether a retry can succeed without other changes: the connection was lost, a message was corrupted in transit,
  /// the caller missed a step's deadline, or its robots are still held by its previous connection.
  bool isTransient() const { return is_transient_; }

 private:
  grpc::StatusCode code_;
  v1::ErrorReason reason_;
  bool is_transient_;
};

/// ConnectOptions::channel, or else a new channel to the environment, which connects when first used.
/// @throws ConfigError for a token that would cross the network unencrypted.
std::shared_ptr<grpc::Channel> connect(const ConnectOptions& options);

/// Adds the token to the metadata of a call that has not started.
void attachToken(grpc::ClientContext& call, const ConnectOptions& options);

}  // namespace robosim
