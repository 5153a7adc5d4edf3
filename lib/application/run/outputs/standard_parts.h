#pragma once

namespace robosim {

/// Lets this program read maps and render cameras: useMapFormats() and setImageSourceMaker(). To be called before the
/// first world is read. useLoadedParts() (run/loaded_parts.h) does the same by libraries that it loads when needed.
void useStandardParts();

}  // namespace robosim
