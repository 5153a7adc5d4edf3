// Fuzzes tasks sent to a geometry worker.
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"
#include "wire/geometry_wire.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<internal::Task>(data, size, [](const internal::Task& task) {
    Environment& replica = smallMaze();
    State state = replica.state();
    if (task.has_state()) decodeInto(task.state(), state);
    putCommands(task, replica);
    putOutcome(task, replica);
  });
}
