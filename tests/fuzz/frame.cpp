// What an environment shows to viewers.
#include "server/sight.h"
#include "server/world_wire.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

namespace {

/// A viewer that has seen the small maze once.
Sight sightOfTheMaze() {
  wire::Frame frame;
  encode(readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"), *frame.mutable_world());
  frame.set_period_s(0.1);
  for (std::size_t i = 0; i < smallMaze().robotCount(); ++i) encode(RobotLook{}, i, *frame.add_robots());
  Sight sight;
  update(sight, frame);
  return sight;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Sight seen = sightOfTheMaze();
  return fuzzMessage<wire::Frame>(data, size, [](const wire::Frame& frame) {
    Sight sight = seen;
    update(sight, frame);
  });
}
