#include "net/connect.h"

#include <cstdlib>

#include "base/error_list.h"
#include "net/access.h"
#include "net/deadlock_detection.h"
#include "net/host_port.h"
#include "net/net_log.h"
#include "net/tls.h"

namespace robosim {
namespace {

std::string describe(const grpc::Status& status, const ConnectOptions& connect_options) {
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) {
    return "the environment at " + connect_options.address +
           " does not provide this service at this port; check the port (serve --listen viewers=…,robots=…)";
  }
  const bool is_from_server = detailOf(status).has_value();
  if (status.error_code() == grpc::StatusCode::CANCELLED && !is_from_server) {
    return "the environment at " + connect_options.address +
           " closed the connection before it responded; its run may have ended";
  }
  if (is_from_server || status.error_code() != grpc::StatusCode::UNAVAILABLE) {
    return "the environment at " + connect_options.address + ": " + status.error_message();
  }
  const std::string why = connect_options.tls ? diagnoseTls(connect_options.address, connect_options.trusted_pem,
                                                            connect_options.connect_limit)
                                              : "";
  if (!why.empty()) {
    return "no TLS with the environment at " + connect_options.address + ": " + why +
           "; is it started with --tls-cert, is that certificate valid and for this address, and does --tls-ca name it "
           "or its issuer?";
  }
  return "no environment answers at " + connect_options.address + " (" + status.error_message() +
         "); is 'robosim serve' running, and is this its address?" +
         (connect_options.tls ? "" : " And if it is started with --tls-cert, add --tls-ca");
}

/// gRPC handles the events of a client's connection while a thread waits for a call, and else at this interval, 5 s by
/// default. While a server is absent calls fail without a wait, so that attempts would exceed connect_limit before the
/// first frames or the TLS handshake are complete, even when the server has returned.
void handleEventsBetweenCalls() {
  static const int is_set = setenv("GRPC_CLIENT_CHANNEL_BACKUP_POLL_INTERVAL_MS", "100", 0);
  static_cast<void>(is_set);
}

}  // namespace

ConnectionError::ConnectionError(const grpc::Status& status, const ConnectOptions& connect_options)
    : std::runtime_error(describe(status, connect_options)),
      code_(status.error_code()),
      reason_(reasonOf(status)),
      is_transient_(robosim::isTransient(status)) {}

std::shared_ptr<grpc::Channel> connect(const ConnectOptions& options) {
  if (!options.token.empty() && !options.tls && !options.may_send_token_unencrypted && !isLoopback(options.address)) {
    throw ConfigError("the token would be sent to " + options.address +
                      " unencrypted; add --tls-ca FILE, or --send-token-unencrypted if the network is trusted");
  }
  if (options.channel) return options.channel;
  disableDeadlockDetection();
  limitGrpcLog();
  handleEventsBetweenCalls();  // before gRPC is initialised; a server waits for events anyway
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // the size of the environment's messages depends on its world
  // By default, gRPC's back-off between reconnection attempts grows to two minutes.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  // gRPC uses this value as its connection timeout; 20 s by default.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, static_cast<int>(options.connect_limit.count()));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, static_cast<int>(options.keepalive.count()));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, static_cast<int>(options.keepalive.count()));
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // Disables unused filters that every message would pass.
  arguments.SetInt(GRPC_ARG_MINIMAL_STACK, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  arguments.SetInt(GRPC_ARG_ENABLE_CHANNELZ, 0);
  if (!options.shares_connections) arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  if (!options.tls) return grpc::CreateCustomChannel(options.address, grpc::InsecureChannelCredentials(), arguments);
  grpc::SslCredentialsOptions trust;
  trust.pem_root_certs = options.trusted_pem;
  return grpc::CreateCustomChannel(options.address, grpc::SslCredentials(trust), arguments);
}

void attachToken(grpc::ClientContext& call, const ConnectOptions& options) {
  if (!options.token.empty()) call.AddMetadata(kTokenKey, std::string(kTokenPrefix) + options.token);
}

}  // namespace robosim
