#include <iostream>

#include <CLI/CLI.hpp>

#include "net/redial.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/subcommands.h"
#include "server/geometry_worker.h"

namespace robosim {
namespace {

struct Arguments {
  ConnectionArguments connection;
  int threads = 1;
  double patience_s = 10;
};

void work(const Arguments& arguments) {
  GeometryWorker worker(arguments.connection.dialOptions(), arguments.threads);
  worker.connect();
  std::cout << "at work on the world " << worker.world().name << std::endl;
  Redial redial(std::chrono::duration<double>(arguments.patience_s),
                [](const std::string& line) { std::cerr << "robosim geometry: " + line + "\n"; });
  redial.keepTalking([&] { worker.work(); }, [&] { worker.connect(); });
  std::cout << "the run is over" << std::endl;
}

}  // namespace

void addGeometry(CLI::App& program) {
  auto* command =
      program.add_subcommand("geometry", "Help an environment elsewhere: work out its robots' moves and readings");
  auto a = std::make_shared<Arguments>();
  addConnectionOptions(*command, a->connection);
  command->add_option("--threads", a->threads, "the run is the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  addPatience(*command, a->patience_s);
  command->callback([a] { work(*a); });
}

}  // namespace robosim
