// What an environment gives a geometry worker to do.
#include "net/robot_wire.h"
#include "server/geometry_wire.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::Task>(data, size, [](const wire::Task& task) {
    Environment& replica = smallMaze();
    if (task.has_moment()) decode(task.moment(), replica.robotCount());
    for (const auto& command : task.commands()) decode(command, replica.robotCount());
    putOutcome(task, replica);
  });
}
