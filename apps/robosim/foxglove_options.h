#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "foxglove/server.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// Arguments of --foxglove and the option that belongs to it.
struct FoxgloveArguments {
  std::string address;  ///< empty: none
  std::vector<std::string> origins;
};

/// Adds --foxglove and --foxglove-origin. @param help of --foxglove @param group of the help text
CLI::Option* addFoxgloveOptions(CLI::App& command, FoxgloveArguments& arguments, const std::string& help,
                                const char* group);

/// The server that they request. @param is_unprotected whether other machines may connect without TLS and tokens
/// @param log takes one line; thread-safe
/// @throws ConfigError for an address that is invalid, or exposed without protection
foxglove::Server::Options foxgloveServer(const FoxgloveArguments& arguments, const std::optional<TlsIdentity>& tls,
                                         const Access& access, bool is_unprotected,
                                         const std::function<void(const std::string&)>& log);

}  // namespace robosim
