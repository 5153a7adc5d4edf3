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
  auto listener = std::make_shared<const ConnectionListener>(address, options.option);
  open.number = listener->port();
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive_ms);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive_ms);
  // Permits clients' keepalive pings at this rate; by default, gRPC would disconnect such clients.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, keepalive_ms / 2);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 0);  // disables unused statistics
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kCallsMost);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, idle_limit_ms);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, idle_limit_ms);
  using Acceptor = grpc::experimental::ExternalConnectionAcceptor;
  using Kind = grpc::ServerBuilder::experimental_type::ExternalConnectionType;
  const std::shared_ptr<Acceptor> plain =
      builder.experimental().AddExternalConnectionAcceptor(Kind::FROM_FD, grpc::InsecureServerCredentials());
  const std::shared_ptr<Acceptor> encrypted =
      options.tls ? builder.experimental().AddExternalConnectionAcceptor(Kind::FROM_FD, options.tls->credentials())
                  : nullptr;
  for (auto* service : services) builder.RegisterService(service);
  open.server = builder.BuildAndStart();
  if (!open.server) {
    throw std::runtime_error("cannot serve on " + address + ": gRPC refuses " +
                             (options.tls ? "the certificate or its key" : "to start"));
  }
  ConnectionGate::Options rules{.access = options.access, .tls = options.tls, .opening_limit = options.idle_limit};
  if (options.standard_services.health) rules.public_paths.emplace_back("/grpc.health.v1.Health/");
  if (options.standard_services.reflection) rules.public_paths.emplace_back("/grpc.reflection.");
  open.gate = std::make_unique<ConnectionGate>(
      std::move(listener), rules, [plain, encrypted](const ConnectionGate::Admitted& admitted) {
        Acceptor::NewConnectionParameters connection;
        connection.listener_fd = admitted.listener;
        connection.fd = admitted.connection;
        if (!admitted.received.empty()) {
          const grpc::Slice received(admitted.received);
          connection.read_buffer = grpc::ByteBuffer(&received, 1);
        }
        (admitted.is_encrypted ? encrypted : plain)->HandleNewConnection(&connection);
      });
  return open;
}

}  // namespace robosim
