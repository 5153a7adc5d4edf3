#include <iostream>

#include <CLI/CLI.hpp>

#include "base/log.h"
#include "base/printable_text.h"
#include "base/seconds.h"
#include "client/geometry_worker.h"
#include "net/reconnector.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

struct GeometryArguments {
  ConnectionArguments connection;
  int threads = 1;
  double reconnect_timeout_s = 10;
};

void work(const GeometryArguments& arguments) {
  const ConnectionArguments& connection = arguments.connection;
  GeometryWorker worker(connection.awaitServer(connection.connectOptions(arguments.reconnect_timeout_s), "geometry"),
                        arguments.threads);
  worker.connect();
  std::cout << "computing for the world " << printableText(worker.world().name) << std::endl;
  Reconnector reconnector(Seconds(arguments.reconnect_timeout_s),
                          [](const std::string& line) { logInfo("geometry", line); });
  reconnector.run([&] { worker.work(); }, [&] { worker.connect(); });
  std::cout << "the run is over" << std::endl;
}

}  // namespace

void addGeometry(CLI::App& program) {
  auto* command = addSubcommand(program, "geometry");
  auto a = std::make_shared<GeometryArguments>();
  addConnectionOptions(*command, a->connection);
  addThreads(*command, a->threads, "number of threads; the run does not depend on it");
  addConnectTimeout(*command, a->connection);
  addReconnectTimeout(*command, a->reconnect_timeout_s);
  command->callback([a] { work(*a); });
}

}  // namespace robosim
