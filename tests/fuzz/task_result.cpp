// What a geometry worker has worked out.
#include "server/geometry_wire.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::TaskResult>(data, size, [](const wire::TaskResult& result) {
    Environment& environment = smallMaze();
    // The conversation has checked the range before it calls.
    if (result.begin() < result.end() && result.end() <= environment.robotCount()) put(result, environment);
  });
}
