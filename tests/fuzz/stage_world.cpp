// Fuzzes worlds of Stage, with a file to include and a bitmap, up to the world and the robot types that they become.
#include "stage/stage_world.h"

#include "robots/fleet.h"
#include "robots/world_source.h"
#include "tests/fuzz/fuzz.h"
#include "world/maps/map_formats.h"

using namespace robosim;

namespace {

constexpr const char* kPart = "define bot position ( ranger ( sensor ( samples 3 fov 90 ) ) )\n";

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  useMapFormats();
  const FileTexts files{{"part.inc", kPart}, {"small.pgm", "P2 3 2 255 0 205 254 0 127 128"}};
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const TranslatedStageWorld world = translateStageWorld(text, "w.world", makeProvider("w.world", files));
    WorldSource source{"w.world", world.text, {}, files};
    for (const auto& [name, type] : world.robot_types) source.robot_types[name] = {name + ".xml", type};
    loadWorld(source, {});
  } catch (const ConfigError&) {
  }
  return 0;
}
