#include "outputs/standard_parts.h"

#include "maps/map_formats.h"
#include "rendering/offscreen_renderer.h"
#include "run/local_run.h"

namespace robosim {

void useStandardParts() {
  useMapFormats();
  setImageSourceMaker(makeOffscreenRenderer);
}

}  // namespace robosim
