#include "net/open_port.h"

#include <stdexcept>

#include "net/lean_locks.h"

namespace robosim {

OpenPort openPort(const std::string& address, const PortOptions& options, const std::vector<grpc::Service*>& services,
                  grpc::ServerBuilder&& builder) {
  useLeanLocks();
  const auto keepalive_ms = static_cast<int>(options.keepalive.count());
  OpenPort open;
  // Without this two programs could share a port unknowingly, and each client reach either.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive_ms);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive_ms);
  // Clients may ask as often; unless told, gRPC would hang up on them for it.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, keepalive_ms / 2);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 0);  // statistics that nobody asks for, of every message
  builder.AddListeningPort(address, options.tls ? options.tls->credentials() : grpc::InsecureServerCredentials(),
                           &open.number);
  for (auto* service : services) builder.RegisterService(service);
  open.server = builder.BuildAndStart();
  if (!open.server || open.number == 0) {
    throw std::runtime_error("cannot listen on " + address + ": is another program using the port? Name another with " +
                             options.option + ", or :0 for any");
  }
  return open;
}

}  // namespace robosim
