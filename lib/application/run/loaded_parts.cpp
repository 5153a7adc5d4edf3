#include "run/loaded_parts.h"

namespace robosim {
namespace {

/// Loads the library at the first call, in whichever thread.
const StandardParts& standardParts() {
  static const StandardParts parts = programFunction<decltype(&robosimStandardParts)>("robosimStandardParts")();
  return parts;
}

FloorPlan readMapByLibrary(const std::string& name, const FileProvider& files, const MapReading& reading) {
  return standardParts().map_readers.read(name, files, reading);
}

std::vector<std::filesystem::path> filesByLibrary(const std::filesystem::path& map) {
  return standardParts().map_readers.files(map);
}

std::unique_ptr<ImageSource> imageSourceByLibrary(const World& world, const Fleet& fleet) {
  return standardParts().make_image_source(world, fleet);
}

}  // namespace

const char* const kProgramLibrary = "librobosim-program.so." ROBOSIM_SOVERSION;
const char* const kProgramPackage = "librobosim-extra" ROBOSIM_SOVERSION;

void useLoadedParts() {
  setMapReaders({.read = readMapByLibrary, .files = filesByLibrary});
  setImageSourceMaker(imageSourceByLibrary);
}

}  // namespace robosim
