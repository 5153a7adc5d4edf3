#include "net/dial.h"

#include "base/error_list.h"
#include "net/access.h"
#include "net/lean_locks.h"
#include "net/listen.h"
#include "net/tls.h"

namespace robosim {
namespace {

std::string told(const grpc::Status& status, const DialOptions& dialled) {
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) {
    return "the environment at " + dialled.address +
           " has nothing of the kind; is this the port for what you want of it? (serve --listen viewers=…,robots=…)";
  }
  // gRPC's own word, for whoever did not say more.
  if (status.error_code() == grpc::StatusCode::CANCELLED && status.error_message() == "CANCELLED") {
    return "the environment at " + dialled.address + " hung up before it answered; its run may just have ended";
  }
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE) {
    return "the environment at " + dialled.address + ": " + status.error_message();
  }
  const std::string why = dialled.tls ? whyTlsFails(dialled.address, dialled.trusted_pem) : "";
  if (!why.empty()) {
    return "no TLS with the environment at " + dialled.address + ": " + why +
           "; is it started with --tls-cert, is that certificate in date and for this address, and does --tls-ca name "
           "it "
           "or who signed it?";
  }
  return "no environment answers at " + dialled.address + " (" + status.error_message() +
         "); is 'robosim serve' running, and is this its address?" +
         (dialled.tls ? "" : " And if it is started with --tls-cert, add --tls-ca");
}

}  // namespace

ConnectionError::ConnectionError(const grpc::Status& status, const DialOptions& dialled)
    : std::runtime_error(told(status, dialled)), code_(status.error_code()) {}

bool ConnectionError::mayPass() const {
  return code_ == grpc::StatusCode::UNAVAILABLE || code_ == grpc::StatusCode::DEADLINE_EXCEEDED ||
         code_ == grpc::StatusCode::ALREADY_EXISTS;
}

std::shared_ptr<grpc::Channel> dial(const DialOptions& options) {
  if (!options.token.empty() && !options.tls && !options.insecure && !isLoopback(options.address)) {
    throw ConfigError("the token would go to " + options.address +
                      " for anyone on the way to read; add --tls-ca FILE, or --insecure if the way is safe");
  }
  useLeanLocks();
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // what the environment sends is as large as its world
  // gRPC would wait longer and longer before it tries a broken connection again, up to two minutes.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, static_cast<int>(options.keepalive.count()));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, static_cast<int>(options.keepalive.count()));
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // What we have no use for, and what each message would go through.
  arguments.SetInt(GRPC_ARG_MINIMAL_STACK, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  arguments.SetInt(GRPC_ARG_ENABLE_CHANNELZ, 0);
  if (!options.tls) return grpc::CreateCustomChannel(options.address, grpc::InsecureChannelCredentials(), arguments);
  grpc::SslCredentialsOptions trust;
  trust.pem_root_certs = options.trusted_pem;
  return grpc::CreateCustomChannel(options.address, grpc::SslCredentials(trust), arguments);
}

void showToken(grpc::ClientContext& call, const DialOptions& options) {
  if (!options.token.empty()) call.AddMetadata(kTokenKey, std::string(kTokenPrefix) + options.token);
}

}  // namespace robosim
