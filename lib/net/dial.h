#pragma once
#include <memory>
#include <stdexcept>
#include <string>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// Whom a client calls.
struct DialOptions {
  std::string address = "127.0.0.1:3000";  ///< "host:port"
};

/// A call came to no good end: what, where and the mend.
class ConnectionError : public std::runtime_error {
 public:
  ConnectionError(const grpc::Status& status, const std::string& address);
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
};

/// A connection to the environment; made when first used.
std::shared_ptr<grpc::Channel> dial(const DialOptions& options);

}  // namespace robosim
