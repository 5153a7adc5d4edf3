#include <cstdlib>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "remote/console.h"
#include "remote/robot_list.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/interrupt.h"
#include "robosim/remote_joystick.h"
#include "robosim/remote_map.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

constexpr const char* kSession =
    "A drive through the small maze, in four terminals:\n"
    "  robosim serve worlds/small_maze.xml --wait-for-robots --speed 1 --step 0.02\n"
    "  robosim robot Pioneer1 --remote-port 9001\n"
    "  robosim robot Scout1 --remote-port 9002\n"
    "  robosim remote worlds/teams/small_maze.xml      (and open the address that it prints)\n"
    "The page says how to drive with keyboard, gamepad or touch. With a joystick of this machine it goes without:\n"
    "  robosim remote worlds/teams/small_maze.xml --joystick 0\n"
    "For others to reach the page, add a certificate and tokens:\n"
    "  robosim remote ROBOTS.xml --listen 0.0.0.0:8443 --tls-cert cert.pem --tls-key key.pem --tokens tokens\n"
    "Whoever opens https://HOST:8443/#token=TOKEN may drive; a token of the role viewer lets them look on.\n";

struct Arguments {
  std::string robots;
  std::string listen = "127.0.0.1:8080";
  ListenerArguments listener;
  ConnectionArguments connection;
  std::optional<int> joystick;
};

void log(const std::string& line) { std::cerr << "robosim remote: " + line + "\n"; }

std::vector<RobotAddress> readTeam(const std::string& file) {
  ErrorList errors;
  auto team = readRobotList(file, errors);
  errors.throwIfAny();
  return team;
}

void openConsole(const Arguments& arguments) {
  const Interrupt interrupt;
  const auto team = readTeam(arguments.robots);
  const DialOptions dialled = arguments.connection.dialOptions();
  ViewerMap map(dialled);
  Console::Options options;
  options.listen = hostAndPort(arguments.listen);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access();
  if (!arguments.connection.insecure) {
    refuseExposure("--listen", options.listen, options.tls.has_value(), !options.access.isOpen());
  }
  options.control.dial = dialled;
  options.map = &map;
  options.log = log;
  Console console(options, team);
  const std::string host = options.listen.substr(0, options.listen.rfind(':'));
  log("the console is at " + std::string(options.tls ? "https" : "http") + "://" + host + ":" +
      std::to_string(console.port()) + "/");
  console.serve([&] { return interrupt.asked(); });
}

void openJoystick(const Arguments& arguments) {
  const Interrupt interrupt;
  RemoteControl::Options options;
  options.driver = "the joystick";
  options.dial = arguments.connection.dialOptions();
  RemoteControl control(readTeam(arguments.robots), options);
  driveByJoystick(
      control, *arguments.joystick, [&] { return interrupt.asked(); }, log);
}

}  // namespace

void addRemote(CLI::App& program) {
  auto* command = program.add_subcommand("remote", "Drive one robot of a team, from a web page or with a joystick");
  auto a = std::make_shared<Arguments>();
  command->add_option("ROBOTS", a->robots, "robot list: where each robot's program listens (robot --remote-port)")
      ->type_name("FILE")
      ->required();
  auto* listen = command->add_option("--listen", a->listen, "where browsers find the page")
                     ->type_name("HOST:PORT")
                     ->capture_default_str();
  command
      ->add_option(
          "--joystick", a->joystick,
          "drive with this joystick, 0 for the first, and no page: the handle steers; button 1 switches to the "
          "next robot, 2 checks win, 3 accelerates, 4 decelerates")
      ->check(CLI::Range(0, 31))
      ->type_name("N")
      ->excludes(listen);
  addListenerOptions(*command, a->listener);
  addConnectionOptions(*command, a->connection);
  command->footer(kSession);
  command->callback([a] { a->joystick ? openJoystick(*a) : openConsole(*a); });
}

}  // namespace robosim
