// Fuzzes the frames that an environment sends to viewers.
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"
#include "wire/viewed_run.h"
#include "wire/world_wire.h"

using namespace robosim;

namespace {

/// A viewer that has received a first frame of the small maze.
ViewedRun mazeRun() {
  v1::Frame frame;
  encode(readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"), *frame.mutable_world()->mutable_source());
  frame.mutable_world()->set_period_s(0.1);
  for (std::size_t i = 0; i < smallMaze().robotCount(); ++i) encode(RobotSnapshot{}, i, *frame.add_robots());
  ViewedRun run;
  update(run, frame);
  return run;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ViewedRun first_frame = mazeRun();
  return fuzzMessage<v1::Frame>(data, size, [](const v1::Frame& frame) {
    ViewedRun run = first_frame;
    update(run, frame);
  });
}
