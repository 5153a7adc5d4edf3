#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>
#include <google/protobuf/stubs/logging.h>

#include "base/error_list.h"
#include "maze/controllers.h"
#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/interrupt.h"
#include "robosim/run_outputs.h"
#include "robosim/subcommands.h"
#include "robots/world_source.h"
#include "server/environment_server.h"

namespace robosim {
namespace {

constexpr const char* kSession =
    "A session in three terminals:\n"
    "  robosim serve worlds/small_maze.xml --wait-for-robots --speed 10\n"
    "  robosim robot Pioneer1 Scout1\n"
    "  robosim control status --watch       (also: pause, step 10, start, speed 2, load FILE, stop)\n"
    "The same from another machine: make a certificate and a token for each client,\n"
    "  openssl req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out cert.pem -days 365 \\\n"
    "      -subj /CN=sim -addext subjectAltName=DNS:sim.example.org\n"
    "  (umask 077; echo \"$(openssl rand -hex 16) operator\" >tokens)\n"
    "  robosim serve WORLD --listen 0.0.0.0:3000 --tls-cert cert.pem --tls-key key.pem --tokens tokens\n"
    "and there, with cert.pem and the token alone in a file of mode 600:\n"
    "  robosim control sim.example.org:3000 status --tls-ca cert.pem --token-file token\n"
    "With a control panel's load the next run begins; its recording and picture get a number: run_2.rawlog.\n";

struct Arguments {
  RunArguments of_run;
  bool wait_for_robots = false;
  std::string listen = kDefaultListen;
  std::string pace = "lockstep";
  double step_deadline_s = 1;
  bool paused = false;
  ListenerArguments listener;
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

/// "run.rawlog" → "run_2.rawlog" for the second run; an empty name stays empty.
std::string numbered(const std::string& file, int number) {
  if (file.empty() || number == 1) return file;
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + "_" + std::to_string(number) + path.extension().string()))
      .string();
}

/// One run of one world: its own controllers, its outputs, and what is shown of it.
struct Stage {
  RunArguments arguments;
  std::vector<std::uint8_t> networked;
  LocalRun run;
  Exhibit exhibit;
  RunOutputs outputs;
  std::optional<std::uint64_t> late;  ///< robot-steps whose command came too late; at the pace of real time only
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

  Stage(LoadedWorld world, const WorldSource& source, const Arguments& a, RunArguments of_this_run)
      : arguments(std::move(of_this_run)),
        networked(networkedRobots(world.fleet, a)),
        run(std::move(world), arguments.run, networked),
        exhibit(run.environment(), source, arguments.run.environment.seed, networked),
        outputs(arguments, run.environment(), noteOf(source, run, arguments.run, networked)) {
    outputs.observe(run.environment());
    if (a.pace == "realtime") late = 0;
  }

  void finish(EndedBy ended_by) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    outputs.finish(run, wall.count(), ended_by, late);
  }
};

/// The runs of one program: a control panel that loads another world begins the next. Each has outputs of its own.
class WorldRun final : public ServedRun {
 public:
  explicit WorldRun(const Arguments& arguments) : arguments_(arguments) {
    stage_ = stageOf(readWorldSource(arguments.of_run.world), 1);
  }

  Environment& environment() override { return stage_->run.environment(); }
  /// Keeps the run alive for as long as anyone looks at it.
  std::shared_ptr<const Exhibit> exhibit() const override { return {stage_, &stage_->exhibit}; }
  void decide() override { stage_->run.decide(); }
  void stepped(std::size_t late) override {
    if (stage_->late) *stage_->late += late;
    stage_->run.noteOutcome();
    stage_->outputs.observe(stage_->run.environment());
  }
  bool isOver() const override {
    return stage_->run.gold().all_halted_s.has_value() || arguments_.of_run.timeIsUp(stage_->run.environment().time());
  }
  void load(const WorldSource& source) override {
    std::shared_ptr<Stage> next;
    try {
      next = stageOf(source, number_ + 1);
    } catch (const RecordingError& error) {  // of the next run; this one goes on
      throw ConfigError(error.what());
    }
    stage_->finish(EndedBy::control_panel);
    stage_ = std::move(next);
    ++number_;
  }

  void keep() { stage_->outputs.keep(stage_->run.environment()); }
  void finish(Served how) {
    stage_->finish(how == Served::interrupted                    ? EndedBy::interrupt
                   : how == Served::stopped                      ? EndedBy::control_panel
                   : stage_->run.gold().all_halted_s.has_value() ? EndedBy::all_halted
                                                                 : EndedBy::time_limit);
  }

 private:
  std::shared_ptr<Stage> stageOf(const WorldSource& source, int number) const {
    RunArguments of_this_run = arguments_.of_run;
    of_this_run.world = source.file;
    of_this_run.record = numbered(of_this_run.record, number);
    of_this_run.picture = numbered(of_this_run.picture, number);
    LoadedWorld world = loadWorldToRun(source, of_this_run.run.controller);
    return std::make_shared<Stage>(std::move(world), source, arguments_, std::move(of_this_run));
  }

  const Arguments& arguments_;
  std::shared_ptr<Stage> stage_;
  int number_ = 1;
};

ServerOptions serverOptions(const Arguments& arguments) {
  ServerOptions options;
  options.listen = ListenAddresses::parse(arguments.listen);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access();
  if (!arguments.listener.insecure) refuseExposure(options.listen, options.tls.has_value(), !options.access.isOpen());
  options.step_deadline = std::chrono::milliseconds(std::llround(arguments.step_deadline_s * 1000));
  options.pace = arguments.pace == "realtime" ? Pace::realtime : Pace::lockstep;
  options.speed = speedNumber(arguments.of_run.speed);
  options.is_paused = arguments.paused;
  options.log = [](const std::string& line) { std::cerr << "robosim serve: " + line + "\n"; };
  return options;
}

/// Says where the environment listens: what a script, or a person who let the system choose a port, waits for.
void tellPorts(const ServerOptions& options, const std::array<int, 4>& ports) {
  constexpr const char* clients[] = {"viewers", "robots", "geometry workers", "control panels"};
  const auto addresses = options.listen.all();
  const auto at = [&](std::size_t i) {
    return addresses[i].substr(0, addresses[i].rfind(':') + 1) + std::to_string(ports[i]);
  };
  std::string line = "robosim serve: listening on " + at(0);
  if (std::count(addresses.begin(), addresses.end(), addresses[0]) < 4) {
    line = "robosim serve: listening";
    for (std::size_t i = 0; i < 4; ++i) line += (i == 0 ? " for " : ", for ") + (clients[i] + (" on " + at(i)));
  }
  std::cerr << line << std::endl;
}

void serveWorld(const Arguments& arguments) {
  const Interrupt interrupt;
  arguments.of_run.check();
  google::protobuf::SetLogHandler(nullptr);  // what a client sends amiss, our own log tells
  const ServerOptions options = serverOptions(arguments);
  WorldRun run(arguments);
  EnvironmentServer server(options, run.exhibit());
  tellPorts(options, server.ports());
  Served how = Served::interrupted;
  try {
    how = server.serve(run, [&] { return interrupt.asked(); });
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    run.keep();
    throw;
  }
  run.finish(how);
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
  addListenerOptions(*command, a->listener);
  command->add_flag("--insecure", a->listener.insecure, "listen to other machines also without TLS and tokens");
  command->footer(std::string(kSession) + "\n" + controllersHelp());
  command->callback([a] { serveWorld(*a); });
}

}  // namespace robosim
