#include "run/outputs/standard_parts.h"

#include "rendering/offscreen_renderer.h"
#include "run/loaded_parts.h"
#include "world/maps/map_formats.h"

namespace robosim {

void useStandardParts() {
  const StandardParts parts = robosimStandardParts();
  setMapReaders(parts.map_readers);
  setImageSourceMaker(parts.make_image_source);
}

}  // namespace robosim

__attribute__((visibility("default"))) robosim::StandardParts robosimStandardParts() {
  return {robosim::mapReadersOfAllFormats(), robosim::makeOffscreenRenderer};
}
