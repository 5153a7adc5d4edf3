#pragma once
#include <memory>
#include <stdexcept>
#include <string>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// Whom a client calls, and how.
struct DialOptions {
  std::string address = "127.0.0.1:3000";  ///< "host:port"
  bool tls = false;
  std::string trusted_pem{}; ///< with TLS, the certificates to trust; empty for the system's authorities
  std::string token{};      ///< shown with every call; empty for none
  bool insecure = false;  ///< show the token without TLS to other machines as well, where anyone on the way can read it
};

/// A call came to no good end: what, where and the mend.
class ConnectionError : public std::runtime_error {
 public:
  ConnectionError(const grpc::Status& status, const DialOptions& dialled);
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
};

/// A connection to the environment; made when first used.
/// @throws ConfigError for a token that would cross the network in clear text.
std::shared_ptr<grpc::Channel> dial(const DialOptions& options);

/// Shows the token with a call: before the call is made.
void showToken(grpc::ClientContext& call, const DialOptions& options);

}  // namespace robosim
