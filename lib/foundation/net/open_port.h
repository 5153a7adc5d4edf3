#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "net/connect.h"
#include "net/connection_gate.h"
#include "net/tls.h"

namespace robosim {

/// A server that listens at one address.
struct OpenPort {
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<ConnectionGate> gate;  ///< accepts the connections; destroyed first
  int number = 0;                        ///< TCP port
};

/// Services of gRPC itself. They answer every client, without a token, on threads of their own (doc/security.md).
struct StandardServices {
  bool health = false;      ///< grpc.health.v1.Health: whether the server is up, as the state of the service ""
  bool reflection = false;  ///< grpc.reflection.v1alpha.ServerReflection: descriptions of services and messages
};

struct PortOptions {
  std::optional<TlsIdentity> tls;                    ///< nullopt: without TLS
  std::string option;                                ///< command-line option of the address, for the error text
  std::chrono::milliseconds keepalive = kKeepalive;  ///< as in ConnectOptions
  /// Timeout for a connection's handshake (TLS, and the first frames of HTTP/2), and for a connection without calls.
  std::chrono::milliseconds idle_limit{10'000};
  StandardServices standard_services{};
  Access access{};  ///< decides which connections are passed to gRPC; each session checks its client itself
};

/// Starts a gRPC server at an address, "host:port"; port 0 lets the system choose.
/// @param services served at the address; must outlive the server
/// @param builder with the server's completion queue, if it uses one
/// For reflection, its library must be loaded before the builder is created, as CompletionQueueServer does.
/// @throws std::runtime_error with the address and how to fix it when the port is in use.
OpenPort openPort(const std::string& address, const PortOptions& options, const std::vector<grpc::Service*>& services,
                  grpc::ServerBuilder&& builder = {});

}  // namespace robosim
