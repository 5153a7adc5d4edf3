#include "run/outputs/standard_parts.h"

#include "rendering/offscreen_renderer.h"
#include "run/local_run.h"
#include "world/maps/map_formats.h"

namespace robosim {

void useStandardParts() {
  useMapFormats();
  setImageSourceMaker(makeOffscreenRenderer);
}

}  // namespace robosim
