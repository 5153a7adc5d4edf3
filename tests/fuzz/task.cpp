// Fuzzes tasks sent to a geometry worker.
#include "net/robot_wire.h"
#include "server/geometry_wire.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::Task>(data, size, [](const wire::Task& task) {
    Environment& replica = smallMaze();
    State state = replica.state();
    if (task.has_state()) decodeInto(task.state(), state);
    for (const auto& command : task.commands()) decode(command, replica.robotCount());
    putOutcome(task, replica);
  });
}
