#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "robosim/arguments.h"
#include "robosim/cli11_names.h"
#include "robosim/run_arguments.h"
#include "robosim/serve_arguments.h"
#include "robosim/subcommands.h"
#include "serving/arcos_server.h"

namespace robosim {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  robosim arcos maps/office.map                     (a p3dx at the map's home, on port 8101)\n"
    "  robosim arcos maps/office.map -r p3dx -r p3at:Tom (the second one on port 8102)\n"
    "  robosim arcos maps/office.map -R p3dx             (each program gets a robot, on port 8101)\n"
    "In another terminal: any program of ARIA, or  robosim view localhost:3000  to watch.\n"
    "The same with all options of a served run: robosim serve WORLD --arcos 8101\n";

struct MobileSimArguments {
  ServeArguments serve;
  std::vector<std::string> robots;
  int port = 8101;
  std::string start;
  bool has_no_window = false;
};

/// "TYPE" or "TYPE:NAME". @throws ConfigError
AddedRobot robotOf(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  AddedRobot robot{text.substr(0, colon), std::nullopt};
  if (colon < text.size()) robot.name = text.substr(colon + 1);
  if (robot.model.empty() || (colon < text.size() && robot.name.empty())) {
    throw ConfigError("--robot " + text + ": must be a robot type, optionally with a name, as in p3dx or p3dx:Tom");
  }
  return robot;
}

/// X,Y,HEADING in millimetres and degrees, as MobileSim has them. @throws ConfigError
mrpt::math::TPose2D startOf(const std::string& text) {
  try {
    mrpt::math::TPose2D pose = *AddedRobot::parse("type@" + text).world_from_robot;
    constexpr double kMm = 1000;
    return {pose.x / kMm, pose.y / kMm, pose.phi};
  } catch (const ConfigError&) {
    throw ConfigError("--start " + text +
                      ": must be X,Y or X,Y,HEADING, in millimetres and degrees, as in 1000,2500,90");
  }
}

void serveMap(MobileSimArguments arguments) {
  ServeArguments& serve = arguments.serve;
  serve.arcos_all = serve.arcos_maps = true;
  serve.arcos =
      serve.arcos.empty() ? std::to_string(arguments.port) : serve.arcos + ":" + std::to_string(arguments.port);
  if (arguments.robots.empty() && serve.arcos_factory.empty()) arguments.robots.emplace_back("p3dx");
  for (const auto& text : arguments.robots) serve.of_run.changes.robots.push_back(robotOf(text));
  if (!arguments.start.empty() && arguments.robots.empty()) {
    throw ConfigError("--start is for the first robot of -r; those of -R stand at random places");
  }
  if (!arguments.start.empty() && !serve.of_run.changes.robots.empty()) {
    serve.of_run.changes.robots.front().world_from_robot = startOf(arguments.start);
  }
  serveWorld(serve);
}

}  // namespace

void addArcos(CLI::App& program) {
  auto* command = addSubcommand(program, "arcos");
  auto a = std::make_shared<MobileSimArguments>();
  a->serve.of_run.time_s = 1e9;
  a->serve.of_run.speed = "1";
  command
      ->add_option("MAP,-m,--map", a->serve.of_run.world, "map or world file; a shipped one also by name: office.map")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds))
      ->required();
  command
      ->add_option("-r,--robot", a->robots,
                   "a robot of this type at the map's home or next to it, with a port of its own; repeatable. Default: "
                   "p3dx")
      ->type_name("TYPE[:NAME]")
      ->allow_extra_args(false);
  command
      ->add_option("-R,--robot-factory", a->serve.arcos_factory,
                   "a robot of this type for each program that connects, at a random free place, on one port; it "
                   "leaves with the program. NUMBER: the most at once, by default 32")
      ->type_name("TYPE[:NUMBER]");
  command->add_option("--start", a->start, "start pose of the first robot, in millimetres and degrees")
      ->type_name("X,Y,HEADING");
  for (const char* name : {"-r", "-R", "--start"}) command->get_option(name)->group("Robots");
  command->add_option("-p,--port", a->port, "port of the first robot; 0: the system chooses all")
      ->check(wholeNumberIn(0, 65535))
      ->capture_default_str();
  command->add_option("--listen-address", a->serve.arcos, "IP address at which programs connect; default 127.0.0.1")
      ->type_name("ADDRESS");
  command->add_flag("--arcos-unprotected", a->serve.arcos_unprotected,
                    "allow programs from other machines, without passwords or encryption");
  for (const char* name : {"-p", "--listen-address", "--arcos-unprotected"})
    command->get_option(name)->group("Programs of ARIA");
  command->add_option("--speed", a->serve.of_run.speed, "simulated seconds per second")
      ->type_name("X")
      ->capture_default_str();
  command
      ->add_option("--record", a->serve.of_run.record,
                   "record the run to this file, as an MRPT rawlog or, if it ends in .mcap, as "
                   "MCAP with topics of ROS 2")
      ->type_name("FILE")
      ->check(fileName());
  command->add_option("--listen", a->serve.listen, "host:port for viewers and control panels")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command->add_flag("--nogui", a->has_no_window, "accepted for scripts: there is no window; robosim view opens one");
  command->footer(kExamples);
  command->callback([a] { serveMap(*a); });
}

}  // namespace robosim
