#include "robosim/connection.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/seconds.h"
#include "net/first_connection.h"
#include "net/host_port.h"
#include "net/private_file.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"

namespace robosim {
namespace {

/// The only word of the file. @throws ConfigError when there is none, or more.
std::string tokenIn(const std::string& file) {
  std::istringstream words(readPrivateFile(file, "the file of your token"));
  std::string token, more;
  if (!(words >> token) || words >> more) throw ConfigError(file + ": must contain the token and nothing else");
  return token;
}

/// The flag that occurs, of two alternatives.
void refuseInsecure(CLI::App& command) {
  if (command.get_option_no_throw("--insecure") != nullptr) return;
  const auto refuse = [](std::int64_t) {
    throw ConfigError(
        "--insecure is now two options: --send-token-unencrypted, to send your token to another machine without TLS; "
        "and --listen-unprotected, to listen to other machines without TLS and tokens");
  };
  command.add_flag_function("--insecure", refuse)->group("");
}

volatile std::sig_atomic_t reload_requested = 0;

/// Installs a handler for SIGHUP, which requests a reload of the token file instead of ending the program.
void catchReloadSignal() {
  struct sigaction action {};
  action.sa_handler = [](int) { reload_requested = 1; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGHUP, &action, nullptr);
}

/// Whether SIGHUP has been received since the last call.
bool isReloadRequested() {
  if (reload_requested == 0) return false;
  reload_requested = 0;
  return true;
}

}  // namespace

ConnectOptions ConnectionArguments::connectOptions(double reconnect_timeout_s) const {
  ConnectOptions options = connectOptions();
  // The connection attempt and the diagnosis of a TLS failure together stay within `reconnect_timeout_s`.
  constexpr double kMinMs = 100;
  const double half_ms =
      std::clamp(reconnect_timeout_s * 1000 / 2, kMinMs, static_cast<double>(options.connect_limit.count()));
  options.connect_limit = std::chrono::milliseconds(static_cast<std::int64_t>(half_ms));
  return options;
}

ConnectOptions ConnectionArguments::awaitServer(const ConnectOptions& options, const std::string& command) const {
  const Interrupt interrupt;
  return waitForServer(options, Seconds(connect_timeout_s), [&](const std::string& line) {
    if (reports_waiting) logInfo(command, line);
  });
}

ConnectOptions ConnectionArguments::connectOptions() const {
  ConnectOptions options;
  options.address = hostAndPort(environment);
  options.tls = tls || !tls_ca.empty();
  if (!tls_ca.empty()) options.trusted_pem = readTrustedCertificates(tls_ca);
  const char* from_variable = std::getenv("ROBOSIM_TOKEN");
  if (!token_file.empty()) {
    options.token = tokenIn(token_file);
  } else if (from_variable) {
    options.token = from_variable;
  }
  if (!std::all_of(options.token.begin(), options.token.end(), [](char c) { return c > ' ' && c <= '~'; })) {
    throw ConfigError("the token has invalid characters; check " +
                      (token_file.empty() ? "the environment variable ROBOSIM_TOKEN" : token_file));
  }
  options.may_send_token_unencrypted = send_token_unencrypted;
  return options;
}

void addConnectionOptions(CLI::App& command, ConnectionArguments& a) {
  command.add_option("--environment", a.environment, "address of 'robosim serve'")
      ->type_name("HOST:PORT")
      ->capture_default_str()
      ->group(kSecurityGroup);
  addSecurityOptions(command, a);
}

void addSecurityOptions(CLI::App& command, ConnectionArguments& a) {
  command
      .add_option("--tls-ca", a.tls_ca,
                  "use TLS, and trust this certificate (PEM): that of the environment or of its issuer")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--tls", a.tls, "use TLS, and trust the certificates that this system trusts");
  command.add_option("--token-file", a.token_file, "file with the access token, if required; or set ROBOSIM_TOKEN")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--send-token-unencrypted", a.send_token_unencrypted,
                   "send the token to other machines without TLS; it can then be intercepted");
  setGroup(command, kSecurityGroup, {"--tls-ca", "--tls", "--token-file", "--send-token-unencrypted"});
  refuseInsecure(command);
}

void addConnectTimeout(CLI::App& command, ConnectionArguments& a) {
  command
      .add_option("--connect-timeout", a.connect_timeout_s,
                  "how long to wait for an environment that does not listen yet; 0: not at all")
      ->check(numberIn(0, 1e6))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(kSecurityGroup);
}

std::optional<TlsIdentity> ListenerArguments::identity() const {
  if (tls_cert.empty() != tls_key.empty()) {
    throw ConfigError("--tls-cert and --tls-key must be given together");
  }
  if (tls_cert.empty()) return std::nullopt;
  return TlsIdentity::read(tls_cert, tls_key);
}

Access ListenerArguments::access(const std::function<void(const std::string&)>& log) const {
  if (tokens.empty()) return {};
  Access::Options options;
  options.log = log;
  options.is_reload_requested = isReloadRequested;
  Access access = Access::read(tokens, options);
  catchReloadSignal();
  return access;
}

void addListenerOptions(CLI::App& command, ListenerArguments& a) {
  command.add_option("--tls-cert", a.tls_cert, "use TLS, with this certificate (PEM)")
      ->type_name("FILE")
      ->check(fileName());
  command.add_option("--tls-key", a.tls_key, "its private key (PEM), readable by its owner only")
      ->type_name("FILE")
      ->check(fileName());
  command
      .add_option("--tokens", a.tokens,
                  "permitted clients: one line 'TOKEN ROLE [name=NAME] [expires=2027-01-31]' each, where ROLE is "
                  "viewer, robot ROBOT..., geometry, operator or supervisor; reloaded when it changes, and at SIGHUP")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--listen-unprotected", a.unprotected,
                   "listen on other interfaces without TLS and tokens: any client has full access");
  setGroup(command, kSecurityGroup, {"--tls-cert", "--tls-key", "--tokens", "--listen-unprotected"});
  refuseInsecure(command);
}

}  // namespace robosim
