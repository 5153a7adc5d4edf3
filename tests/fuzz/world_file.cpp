// Fuzzes world files, with the robot types shipped with RoboSim and a file to include.
#include "robots/world_source.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

namespace {

constexpr const char* kPart = R"(<surface><scatter count="2" pattern="grid">
  <primitive><cylinder><name>Part</name><z>1</z><radius>0.1</radius><height>2</height></cylinder></primitive>
</scatter></surface>)";

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RobotTypes types = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml").robot_types;
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    loadWorld(WorldSource{"world.xml", text, types, {{"part.xml", kPart}}}, {});
  } catch (const ConfigError&) {
  }
  return 0;
}
