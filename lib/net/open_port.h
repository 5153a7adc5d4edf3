#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "net/tls.h"

namespace robosim {

/// A server at one address, and the port that it has there.
struct OpenPort {
  std::unique_ptr<grpc::Server> server;
  int number = 0;
};

/// Lets clients come in at an address, "host:port"; port 0 lets the system choose.
/// @param tls absent: without TLS
/// @param services what is to be found there; they must outlive the server
/// @param option that names the address, for the error
/// @throws std::runtime_error when the port is taken; what, where and the mend.
OpenPort openPort(const std::string& address, const std::optional<TlsIdentity>& tls,
                  const std::vector<grpc::Service*>& services, const std::string& option);

}  // namespace robosim
