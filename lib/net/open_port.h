#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "net/dial.h"
#include "net/tls.h"

namespace robosim {

/// A server at one address, and the port that it has there.
struct OpenPort {
  std::unique_ptr<grpc::Server> server;
  int number = 0;
};

struct PortOptions {
  std::optional<TlsIdentity> tls;                    ///< absent: without TLS
  std::string option;                                ///< that names the address on the command line, for the error
  std::chrono::milliseconds keepalive = kKeepalive;  ///< as in DialOptions
};

/// Lets clients come in at an address, "host:port"; port 0 lets the system choose.
/// @param services what is to be found there; they must outlive the server
/// @param builder has the server's queue, if it is to have one
/// @throws std::runtime_error when the port is taken; what, where and the mend.
OpenPort openPort(const std::string& address, const PortOptions& options, const std::vector<grpc::Service*>& services,
                  grpc::ServerBuilder&& builder = {});

}  // namespace robosim
