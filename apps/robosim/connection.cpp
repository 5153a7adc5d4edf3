#include "robosim/connection.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "net/private_file.h"
#include "robosim/arguments.h"

namespace robosim {
namespace {

/// The first word of the file. @throws ConfigError when there is none, or more.
std::string tokenIn(const std::string& file) {
  std::istringstream words(readPrivateFile(file, "the file of your token"));
  std::string token, more;
  if (!(words >> token) || words >> more) throw ConfigError(file + ": must have your token and nothing else");
  return token;
}

}  // namespace

DialOptions ConnectionArguments::dialOptions() const {
  DialOptions options;
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
    throw ConfigError("your token has characters that no token has; look at " +
                      (token_file.empty() ? "the environment variable ROBOSIM_TOKEN" : token_file));
  }
  options.insecure = insecure;
  return options;
}

void addConnectionOptions(CLI::App& command, ConnectionArguments& a) {
  command.add_option("--environment", a.environment, "where 'robosim serve' listens")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  addSecurityOptions(command, a);
}

void addSecurityOptions(CLI::App& command, ConnectionArguments& a) {
  command
      .add_option("--tls-ca", a.tls_ca,
                  "speak TLS, and trust this certificate (PEM): the environment's, or its signer's")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--tls", a.tls, "speak TLS, and trust whom this system trusts");
  command.add_option("--token-file", a.token_file, "your token, if the environment asks for one; or set ROBOSIM_TOKEN")
      ->type_name("FILE")
      ->check(fileName());
  command.add_flag("--insecure", a.insecure, "send the token to another machine also without TLS");
}

std::optional<TlsIdentity> ListenerArguments::identity() const {
  if (tls_cert.empty() != tls_key.empty()) {
    throw ConfigError("--tls-cert and --tls-key belong together: give both, or neither");
  }
  if (tls_cert.empty()) return std::nullopt;
  return TlsIdentity::read(tls_cert, tls_key);
}

Access ListenerArguments::access() const { return tokens.empty() ? Access() : Access::read(tokens); }

void addListenerOptions(CLI::App& command, ListenerArguments& a) {
  command.add_option("--tls-cert", a.tls_cert, "speak TLS, with this certificate (PEM)")
      ->type_name("FILE")
      ->check(fileName());
  command.add_option("--tls-key", a.tls_key, "its private key (PEM), which nobody but its owner may read")
      ->type_name("FILE")
      ->check(fileName());
  command
      .add_option("--tokens", a.tokens,
                  "who may come in: a line 'TOKEN viewer', 'TOKEN robot NAME...' or 'TOKEN operator' for each")
      ->type_name("FILE")
      ->check(fileName());
}

}  // namespace robosim
