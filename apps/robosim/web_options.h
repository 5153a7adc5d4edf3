#pragma once
#include <functional>
#include <optional>
#include <string>

#include "live_page/live_page_server.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// Adds --web. @param address of it; empty: none @param help, group of the help text
CLI::Option* addWebOption(CLI::App& command, std::string& address, const std::string& help, const char* group);

/// The server that it requests. @param is_unprotected whether other machines may connect without TLS and tokens
/// @param log takes one line; thread-safe
/// @throws ConfigError for an address that is invalid, or exposed without protection
LivePageServer::Options livePageServer(const std::string& address, const std::optional<TlsIdentity>& tls,
                                       const Access& access, bool is_unprotected,
                                       const std::function<void(const std::string&)>& log);

}  // namespace robosim
