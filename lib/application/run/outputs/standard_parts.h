#pragma once

namespace robosim {

/// Lets this program read maps and render cameras: useMapFormats() and setImageSourceMaker(). To be called before the
/// first world is read; robosimMain() calls it.
void useStandardParts();

}  // namespace robosim
