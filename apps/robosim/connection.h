#pragma once
#include <functional>
#include <optional>
#include <string>

#include "net/access.h"
#include "net/connect.h"
#include "net/listen.h"
#include "net/tls.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// Options of a client: address of the environment and credentials.
struct ConnectionArguments {
  std::string environment = kDefaultListen;
  bool tls = false;
  std::string tls_ca, token_file;
  bool send_token_unencrypted = false;
  double connect_timeout_s = 10;  ///< of awaitServer()
  bool reports_waiting = true;    ///< of awaitServer()

  /// Reads the files. The token comes from a file or from the environment variable ROBOSIM_TOKEN, never from the
  /// command line, which `ps` shows to all users.
  /// @throws ConfigError
  ConnectOptions connectOptions() const;
  /// The same for a client that reconnects for `reconnect_timeout_s` seconds, which also limits the duration of each
  /// attempt.
  ConnectOptions connectOptions(double reconnect_timeout_s) const;
  /// Waits for a server that does not listen yet: waitForServer(). @param command prefix of the line that reports it
  /// @throws Interrupted for a signal in the meantime
  ConnectOptions awaitServer(const ConnectOptions& options, const std::string& command) const;
};

/// Adds `--environment ADDRESS` and the options of addSecurityOptions().
void addConnectionOptions(CLI::App& command, ConnectionArguments& arguments);
void addSecurityOptions(CLI::App& command, ConnectionArguments& arguments);
/// Adds `--connect-timeout`, for programs that call ConnectionArguments::awaitServer().
void addConnectTimeout(CLI::App& command, ConnectionArguments& arguments);

/// Options of a listening program: TLS and access tokens.
struct ListenerArguments {
  std::string tls_cert, tls_key, tokens;
  bool unprotected = false;

  /// nullopt: without TLS. @throws ConfigError
  std::optional<TlsIdentity> identity() const;
  /// The token file is reloaded when it changes, and at SIGHUP. @param log receives a line of text
  /// @throws ConfigError
  Access access(const std::function<void(const std::string&)>& log) const;
};

/// Adds `--tls-cert`, `--tls-key`, `--tokens` and `--listen-unprotected`.
void addListenerOptions(CLI::App& command, ListenerArguments& arguments);

}  // namespace robosim
