#include "net/open_port.h"

#include <stdexcept>

#include <grpcpp/health_check_service_interface.h>

#include "net/deadlock_detection.h"
#include "net/net_log.h"

namespace robosim {
namespace {

/// Maximum number of concurrent calls per connection; the client delays further ones. Otherwise a client could starve
/// the others and exhaust the memory by opening calls.
constexpr int kCallsMost = 128;

}  // namespace

OpenPort openPort(const std::string& address, const PortOptions& options, const std::vector<grpc::Service*>& services,
                  grpc::ServerBuilder&& builder) {
  disableDeadlockDetection();
  limitGrpcLog();
  const auto keepalive_ms = static_cast<int>(options.keepalive.count());
  const auto idle_limit_ms = static_cast<int>(options.idle_limit.count());
  grpc::EnableDefaultHealthCheckService(options.standard_services.health);
  OpenPort open;
  open.listener = std::make_unique<ConnectionListener>(address, options.option);
  open.number = open.listener->port();
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive_ms);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive_ms);
  // Permits clients' keepalive pings at this rate; by default, gRPC would disconnect such clients.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, keepalive_ms / 2);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 0);  // disables unused statistics
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kCallsMost);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, idle_limit_ms);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, idle_limit_ms);
  // Shared, because connections may be accepted while the server is being created.
  const std::shared_ptr acceptor = builder.experimental().AddExternalConnectionAcceptor(
      grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD,
      options.tls ? options.tls->credentials() : grpc::InsecureServerCredentials());
  for (auto* service : services) builder.RegisterService(service);
  open.server = builder.BuildAndStart();
  if (!open.server) {
    throw std::runtime_error("cannot serve on " + address + ": gRPC refuses " +
                             (options.tls ? "the certificate or its key" : "to start"));
  }
  open.listener->start([acceptor](int listener, int connection) {
    grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters accepted;
    accepted.listener_fd = listener;
    accepted.fd = connection;
    acceptor->HandleNewConnection(&accepted);
  });
  return open;
}

}  // namespace robosim
