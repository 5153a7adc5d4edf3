#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "aria/robot_list.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "client/run_monitor.h"
#include "client/viewer_map.h"
#include "console/console.h"
#include "net/host_port.h"
#include "net/listen.h"
#include "remote/orders.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/connection.h"
#include "robosim/remote_joystick.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

constexpr const char* kRemoteSession =
    "Example: drive through a maze, in four terminals:\n"
    "  robosim serve open_house --wait-for-robots --speed 1 --step 0.02\n"
    "  robosim robot Pioneer1 --remote-port 9001\n"
    "  robosim robot Scout1 Pioneer2 --remote-port 9002\n"
    "  robosim remote worlds/teams/open_house.xml      (then open the address that it prints)\n"
    "The page explains driving with keyboard, gamepad or touch. With a local joystick no page is needed:\n"
    "  robosim remote worlds/teams/open_house.xml --joystick 0\n"
    "For access from other machines, add a certificate and tokens:\n"
    "  robosim remote ROBOTS.xml --listen 0.0.0.0:8443 --tls-cert cert.pem --tls-key key.pem --tokens tokens\n"
    "Open https://HOST:8443/#token=TOKEN to drive; a token with the role viewer permits viewing only.\n"
    "An open house with rounds of three minutes, for visitors of two teams:\n"
    "  robosim remote ROBOTS.xml --hall 180 --team Red --team Blue --results today.json\n"
    "An operator's page also starts and stops the recording of a run that was started with serve --record.\n";

constexpr std::size_t kMaxTeams = 8;

struct RemoteArguments {
  std::string robots;
  std::string listen = "127.0.0.1:8080";
  ListenerArguments listener;
  ConnectionArguments connection;
  std::optional<int> round_s;
  std::vector<std::string> teams;
  std::string results;
  std::optional<int> joystick;
  int top_speed_percent = 100;
};

void log(const std::string& line) { logInfo("remote", line); }

std::vector<RobotAddress> readTeam(const std::string& file) {
  ErrorList errors;
  auto team = readRobotList(file, errors);
  errors.throwIfAny();
  return team;
}

/// Accepts a name that a button of the page can show.
CLI::Validator teamName() {
  constexpr std::size_t max_bytes = 20;
  return {[](const std::string& name) -> std::string {
            try {
              checkText(name, max_bytes, "the name");
            } catch (const WireError& error) {
              return error.what();
            }
            return name.empty() ? "the name is empty" : "";
          },
          ""};
}

/// An address that a browser can open: the name of this machine instead of all its addresses.
std::string reachable(const std::string& listen) {
  const std::size_t colon = listen.rfind(':');
  const std::string host = listen.substr(0, colon);
  if (host != "0.0.0.0" && host != "[::]") return listen;
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0 || *name == '\0') return listen;
  return name + listen.substr(colon);
}

void openConsole(const RemoteArguments& arguments) {
  const Interrupt interrupt;
  const auto team = readTeam(arguments.robots);
  const ConnectOptions connect_options = arguments.connection.connectOptions();
  ViewerMap map(connect_options);
  RunMonitor run(connect_options,
                 arguments.round_s ? RunMonitor::Restart::at_any_time : RunMonitor::Restart::after_end);
  Console::Options options;
  options.listen = hostAndPort(arguments.listen);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access(log);
  if (!arguments.listener.unprotected) {
    checkExposure("--listen", options.listen, options.tls.has_value(), !options.access.isOpen());
  }
  options.control.connect_options = connect_options;
  options.map = &map;
  options.run = &run;
  if (arguments.teams.size() > kMaxTeams) {
    throw ConfigError("--team: " + std::to_string(arguments.teams.size()) +
                      " teams; at most 8 are possible, drop some");
  }
  if (arguments.round_s) options.rounds = {std::chrono::seconds(*arguments.round_s), arguments.teams};
  options.results = arguments.results;
  options.log = log;
  Console console(options, team);
  log("the console is at " + std::string(options.tls ? "https" : "http") + "://" +
      withPort(reachable(options.listen), console.port()) + "/");
  console.serve([&] { return interrupt.isRequested(); });
}

void openJoystick(const RemoteArguments& arguments) {
  const Interrupt interrupt;
  RemoteControl::Options options;
  options.driver = "the joystick";
  options.connect_options = arguments.connection.connectOptions();
  RemoteControl control(readTeam(arguments.robots), options);
  driveByJoystick(
      control, *arguments.joystick, arguments.top_speed_percent / 100.0, [&] { return interrupt.isRequested(); }, log);
}

}  // namespace

void addRemote(CLI::App& program) {
  auto* command = addSubcommand(program, "remote");
  auto a = std::make_shared<RemoteArguments>();
  command->add_option("ROBOTS", a->robots, "robot list with the address of each robot's program (robot --remote-port)")
      ->transform(inputFile({FileKind::robot_list}))
      ->type_name("FILE")
      ->required();
  auto* listen =
      command->add_option("--listen", a->listen, "address of the page")->type_name("HOST:PORT")->capture_default_str();
  auto* joystick =
      command
          ->add_option(
              "--joystick", a->joystick,
              "drive with this joystick, 0 for the first, without a page: the stick steers; button 1 switches to the "
              "next robot, 2 checks win, 3 accelerates, 4 decelerates, every other button stops")
          ->check(wholeNumberIn(0, 31))
          ->type_name("N")
          ->excludes(listen);
  dependsOn(
      command
          ->add_option("--top-speed", a->top_speed_percent,
                       "the top speed of the joystick's stick and buttons, of the robot's maximum; the page has a "
                       "slider")
          ->check(wholeNumberIn(10, 100))
          ->type_name("PERCENT")
          ->capture_default_str(),
      joystick);
  auto* hall = command
                   ->add_option("--hall", a->round_s,
                                "for an open house: visitors drive in turn, for rounds of this length, each in a new "
                                "run; between them the robot explores by itself")
                   ->check(wholeNumberIn(10, 3600))
                   ->type_name("SECONDS");
  dependsOn(command->add_option("--team", a->teams, "team that visitors may select; repeat it for each, at most 8")
                ->check(teamName())
                ->allow_extra_args(false)
                ->type_name("NAME"),
            hall);
  command
      ->add_option("--results", a->results,
                   "keeps the results of the day in this file, so that another console continues the list")
      ->check(fileName())
      ->type_name("FILE");
  addListenerOptions(*command, a->listener);
  for (const char* name :
       {"--hall", "--team", "--results", "--tls-cert", "--tls-key", "--tokens", "--listen-unprotected"}) {
    joystick->excludes(command->get_option(name));
  }
  addConnectionOptions(*command, a->connection);
  command->footer(kRemoteSession);
  command->callback([a] { a->joystick ? openJoystick(*a) : openConsole(*a); });
}

}  // namespace robosim
