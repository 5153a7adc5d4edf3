#include "robosim/ros2_arguments.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "dds/participant.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

/// The domain of ROS_DOMAIN_ID, or 0. @throws ConfigError
int domainOfEnvironment() {
  const char* const variable = std::getenv("ROS_DOMAIN_ID");
  if (!variable || !*variable) return 0;
  const std::string_view text = variable;
  int domain = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error == std::errc{} && end == text.data() + text.size() && domain >= 0 && domain <= dds::kMaxDomain)
    return domain;
  throw ConfigError("ROS_DOMAIN_ID=" + std::string(text) + ": must be a domain of ROS 2, from 0 to " +
                    std::to_string(dds::kMaxDomain));
}

}  // namespace

void addRos2Options(CLI::App& command, Ros2Arguments& a, const char* group, bool has_network) {
  const CLI::Option* const ros2 =
      command
          .add_flag(std::string(kRos2Option), a.is_on,
                    "publish the topics of ROS 2 over DDS, and let ROS 2 drive robots by /<robot>/cmd_vel; on this "
                    "machine only" +
                        std::string(has_network ? " unless --ros2-interface or --ros2-peer is given" : "") +
                        " (doc/ros2.md)")
          ->group(group);
  const auto add = [&](CLI::Option* option) {
    dependsOn(option, ros2);
    return option->group(group);
  };
  addRos2NetworkOptions(command, a.network, ros2, group, has_network);
  add(command.add_option("--namespace", a.name_space, "before the names of all topics but /clock, /tf and /tf_static"))
      ->type_name("NAME");
  add(command.add_option("--ros2-tf", a.trees,
                         "trees of frames. common: one on /tf, with the robot's name as a prefix; robot: one for each "
                         "on /<robot>/tf, without a prefix, as Nav2 expects it"))
      ->check(CLI::IsMember({"common", "robot"}))
      ->capture_default_str();
  add(command.add_flag("--ros2-supervise", a.may_supervise,
                       "let ROS 2 place robots by /<robot>/initialpose, and add and remove robots and objects by "
                       "/robosim/spawn and /robosim/remove"));
  if (!has_network) return;
  add(command.add_flag("--ros2-unprotected", a.is_unprotected,
                       "let all programs that reach the domain read the topics and drive, without passwords or "
                       "encryption; needed for other machines, and beside --tokens"));
}

void addRos2NetworkOptions(CLI::App& command, Ros2Network& network, const CLI::Option* ros2, const char* group,
                           bool has_network) {
  const auto add = [&](CLI::Option* option) { return dependsOn(option, ros2)->group(group); };
  add(command.add_option("--domain", network.domain, "domain of ROS 2; without it ROS_DOMAIN_ID, or 0"))
      ->check(wholeNumberIn(0, dds::kMaxDomain))
      ->type_name("NUMBER");
  if (!has_network) return;
  add(command.add_option("--ros2-interface", network.interface,
                         "name or address of the network interface by which other machines are found; without it this "
                         "machine only"))
      ->type_name("NAME|ADDRESS");
  add(command.add_option("--ros2-peer", network.peers, "address of another machine, for networks without multicast"))
      ->allow_extra_args(false)
      ->type_name("ADDRESS");
}

dds::Options ddsOptions(const Ros2Network& network, const std::function<void(const std::string&)>& log) {
  dds::Options options;
  options.domain = network.domain ? *network.domain : domainOfEnvironment();
  options.interface = network.interface;
  options.peers = network.peers;
  options.log = log;
  return options;
}

}  // namespace robosim
