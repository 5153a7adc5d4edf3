#include <chrono>
#include <iostream>
#include <mutex>

#include "maze/controllers.h"
#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/interrupt.h"
#include "robosim/run_outputs.h"
#include "robosim/subcommands.h"
#include "robots/world_source.h"
#include "server/environment_server.h"

namespace robosim {
namespace {

struct Arguments {
  RunArguments of_run;
  bool wait_for_robots = false;
  std::string listen = kDefaultListen;
  std::string pace = "lockstep";
  double step_deadline_s = 1;
  bool paused = false;
};

/// Which robots a process of their own drives: all, if the environment is to wait for them; otherwise those that nobody
/// gives a controller.
std::vector<std::uint8_t> networkedRobots(const Fleet& fleet, const Arguments& arguments) {
  std::vector<std::uint8_t> networked;
  for (const auto& robot : fleet.robots) {
    const bool has_controller = !arguments.of_run.run.controller.empty() || !robot.controller.empty();
    networked.push_back(arguments.wait_for_robots || !has_controller);
  }
  return networked;
}

/// The run of one world, its outputs, and its own controllers.
class WorldRun final : public ServedRun {
 public:
  WorldRun(LoadedWorld world, WorldSource source, const Arguments& arguments)
      : arguments_(arguments.of_run),
        networked_(networkedRobots(world.fleet, arguments)),
        run_(std::move(world), arguments_.run, networked_),
        exhibit_(std::make_shared<Exhibit>(run_.environment(), std::move(source), arguments_.run.environment.seed,
                                           networked_)),
        outputs_(arguments_, run_.environment()) {
    outputs_.observe(run_.environment());
  }

  Environment& environment() override { return run_.environment(); }
  std::shared_ptr<const Exhibit> exhibit() override { return exhibit_; }
  void decide() override { run_.decide(); }
  void stepped() override {
    run_.noteOutcome();
    outputs_.observe(run_.environment());
  }
  bool isOver() const override {
    return run_.gold().all_halted_s.has_value() || arguments_.timeIsUp(run_.environment().time());
  }

  void keep() { outputs_.keep(run_.environment()); }
  void finish(double wall_s, bool came_to_its_end) {
    const EndedBy ended_by = !came_to_its_end           ? EndedBy::interrupt
                             : run_.gold().all_halted_s ? EndedBy::all_halted
                                                        : EndedBy::time_limit;
    outputs_.finish(run_, wall_s, ended_by);
  }

 private:
  RunArguments arguments_;
  std::vector<std::uint8_t> networked_;
  LocalRun run_;
  std::shared_ptr<const Exhibit> exhibit_;
  RunOutputs outputs_;
};

ServerOptions serverOptions(const Arguments& arguments) {
  ServerOptions options;
  options.listen = ListenAddresses::parse(arguments.listen);
  options.step_deadline = std::chrono::milliseconds(std::llround(arguments.step_deadline_s * 1000));
  options.pace = arguments.pace == "realtime" ? Pace::realtime : Pace::lockstep;
  options.speed = arguments.of_run.speedNumber();
  options.is_paused = arguments.paused;
  options.log = [](const std::string& line) { std::cerr << "robosim serve: " + line + "\n"; };
  return options;
}

void serveWorld(const Arguments& arguments) {
  const Interrupt interrupt;
  arguments.of_run.check();
  const std::string& file = arguments.of_run.world;
  WorldRun run(loadWorldToRun(file, arguments.of_run.run.controller), readWorldSource(file), arguments);
  EnvironmentServer server(serverOptions(arguments), run.exhibit());
  std::cerr << "robosim serve: listening on port " << server.ports().front() << std::endl;
  const auto start = std::chrono::steady_clock::now();
  bool came_to_its_end = false;
  try {
    came_to_its_end = server.serve(run, [&] { return interrupt.asked(); });
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    run.keep();
    throw;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  run.finish(wall.count(), came_to_its_end);
}

}  // namespace

void addServe(CLI::App& program) {
  auto* command = program.add_subcommand("serve", "Run a world for robots, viewers and helpers in other processes");
  auto a = std::make_shared<Arguments>();
  addRunArguments(*command, a->of_run);
  command->add_flag("--wait-for-robots", a->wait_for_robots,
                    "leave every robot to a process of its own, also those for which the world names a controller");
  command->add_option("--listen", a->listen, "host:port, or viewers=…,robots=…,geometry=…,control=…")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      ->add_option("--pace", a->pace,
                   "lockstep: a step waits for every robot; realtime: a late robot keeps its last command")
      ->check(CLI::IsMember({"lockstep", "realtime"}))
      ->capture_default_str();
  command->add_option("--step-deadline", a->step_deadline_s, "how long a step waits for a robot before it is let go")
      ->check(numberIn(0.001, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--paused", a->paused, "take no step until a control panel says start");
  command->footer(controllersHelp());
  command->callback([a] { serveWorld(*a); });
}

}  // namespace robosim
