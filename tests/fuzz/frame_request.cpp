// Fuzzes the requests of a viewer.
#include <cstdlib>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"
#include "wire/viewed_run.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<v1::FrameRequest>(data, size, [](const v1::FrameRequest& request) {
    v1::Frame frame;
    SentSteps sent_steps(smallMaze().robotCount());
    encode(smallMaze().state().readings, decode(request, smallMaze().robotCount()), sent_steps, frame);
    if (frame.readings_size() > static_cast<int>(smallMaze().robotCount())) std::abort();
  });
}
