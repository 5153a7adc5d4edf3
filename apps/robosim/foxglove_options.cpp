#include "robosim/foxglove_options.h"

#include <CLI/CLI.hpp>

#include "net/listen.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"
#include "serving/foxglove_serving.h"

namespace robosim {

CLI::Option* addFoxgloveOptions(CLI::App& command, FoxgloveArguments& arguments, const std::string& help,
                                const char* group) {
  CLI::Option* const foxglove =
      command.add_option(std::string(kFoxgloveOption), arguments.address, help)->type_name("[HOST:]PORT");
  dependsOn(command
                .add_option("--foxglove-origin", arguments.origins,
                            "allow pages of another site, such as http://localhost:8080 of a Lichtblick of your own")
                ->allow_extra_args(false)
                ->type_name("ORIGIN"),
            foxglove);
  setGroup(command, group, {"--foxglove", "--foxglove-origin"});
  return foxglove;
}

foxglove::Server::Options foxgloveServer(const FoxgloveArguments& arguments, const std::optional<TlsIdentity>& tls,
                                         const Access& access, bool is_unprotected,
                                         const std::function<void(const std::string&)>& log) {
  foxglove::Server::Options options;
  options.listen = foxgloveAddress(arguments.address);
  options.tls = tls;
  options.access = access;
  options.origins = arguments.origins;
  options.log = log;
  if (!is_unprotected) checkExposure("--foxglove", options.listen, tls.has_value(), !access.isOpen());
  return options;
}

}  // namespace robosim
