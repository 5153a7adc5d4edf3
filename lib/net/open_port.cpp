#include "net/open_port.h"

#include <stdexcept>

#include <sys/resource.h>

#include "net/lean_locks.h"

namespace robosim {
namespace {

/// So many calls there may be on one connection at a time; more wait at their end. Whoever opens them without end else
/// keeps us from everybody, and fills our memory.
constexpr int kCallsMost = 128;

/// Each connection takes a descriptor, and a shell often gives a program 1,024 of those that it may have. Once gRPC has
/// found none for a caller, it never listens again.
void useAllDescriptors() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

}  // namespace

OpenPort openPort(const std::string& address, const PortOptions& options, const std::vector<grpc::Service*>& services,
                  grpc::ServerBuilder&& builder) {
  useLeanLocks();
  useAllDescriptors();
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
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kCallsMost);
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
