// Fuzzes results of a geometry worker.
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"
#include "wire/geometry_wire.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<internal::TaskResult>(data, size, [](const internal::TaskResult& result) {
    Environment& environment = smallMaze();
    // The session checks the range before this call.
    if (result.begin() < result.end() && result.end() <= environment.robotCount()) put(result, environment);
  });
}
