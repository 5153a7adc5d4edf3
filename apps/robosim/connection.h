#pragma once
#include <optional>
#include <string>

#include "net/access.h"
#include "net/dial.h"
#include "net/listen.h"
#include "net/tls.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// How a person says to which environment a program connects, and with which right.
struct ConnectionArguments {
  std::string environment = kDefaultListen;
  bool tls = false;
  std::string tls_ca, token_file;
  bool insecure = false;

  /// Reads the files; the token is in the file, or else in the environment variable ROBOSIM_TOKEN: never on the command
  /// line, where `ps` shows it to everyone.
  /// @throws ConfigError
  DialOptions dialOptions() const;
};

/// Adds `--environment ADDRESS`, and what addSecurityOptions() adds.
void addConnectionOptions(CLI::App& command, ConnectionArguments& arguments);
void addSecurityOptions(CLI::App& command, ConnectionArguments& arguments);

/// How a person says who may come in where a program listens.
struct ListenerArguments {
  std::string tls_cert, tls_key, tokens;
  bool insecure = false;

  /// Absent: without TLS. @throws ConfigError
  std::optional<TlsIdentity> identity() const;
  /// @throws ConfigError
  Access access() const;
};

/// Adds `--tls-cert`, `--tls-key` and `--tokens`.
void addListenerOptions(CLI::App& command, ListenerArguments& arguments);

}  // namespace robosim
