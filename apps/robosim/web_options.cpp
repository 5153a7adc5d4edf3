#include "robosim/web_options.h"

#include <CLI/CLI.hpp>

#include "net/listen.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"

namespace robosim {

CLI::Option* addWebOption(CLI::App& command, std::string& address, const std::string& help, const char* group) {
  return command.add_option(std::string(kWebOption), address, help)->type_name("[HOST:]PORT")->group(group);
}

LivePageServer::Options livePageServer(const std::string& address, const std::optional<TlsIdentity>& tls,
                                       const Access& access, bool is_unprotected,
                                       const std::function<void(const std::string&)>& log) {
  LivePageServer::Options options;
  options.listen = livePageAddress(address);
  options.tls = tls;
  options.access = access;
  options.log = log;
  if (!is_unprotected) checkExposure("--web", options.listen, tls.has_value(), !access.isOpen());
  return options;
}

}  // namespace robosim
