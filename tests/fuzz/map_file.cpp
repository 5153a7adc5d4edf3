// Fuzzes map files of all formats. The first line of the input is the file name, which determines the format; the rest
// is the content. A .yaml file refers to a small image.
#include <algorithm>

#include "tests/fuzz/fuzz.h"
#include "world/maps/map_formats.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  useMapFormats();
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(input.find('\n'), input.size());
  const std::string name = input.substr(0, end);
  const FileTexts files{{"small.pgm", "P2 2 2 255 0 205 254 0"}, {name, input.substr(std::min(end + 1, input.size()))}};
  MapReading reading;
  reading.pixel_m = 0.05;
  try {
    readMap(name, makeProvider("world.xml", files), reading);
  } catch (const ConfigError&) {
  }
  return 0;
}
