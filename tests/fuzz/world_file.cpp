// Fuzzes world files, with the robot types shipped with RoboSim.
#include "robots/world_source.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RobotTypes types = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml").robot_types;
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    loadWorld(WorldSource{"world.xml", text, types}, {});
  } catch (const ConfigError&) {
  }
  return 0;
}
