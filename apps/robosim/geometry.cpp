#include <iostream>

#include "robosim/connection.h"
#include "robosim/subcommands.h"
#include "server/geometry_worker.h"

namespace robosim {
namespace {

struct Arguments {
  ConnectionArguments connection;
  int threads = 1;
};

void work(const Arguments& arguments) {
  workForEnvironment(arguments.connection.dialOptions(), arguments.threads,
                     [](const std::string& line) { std::cout << line << std::endl; });
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
  command->callback([a] { work(*a); });
}

}  // namespace robosim
