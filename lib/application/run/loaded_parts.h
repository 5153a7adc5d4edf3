#pragma once
#include <stdexcept>
#include <string>

#include "base/error_list.h"
#include "base/loaded_function.h"
#include "run/local_run.h"
#include "world/map_reader.h"

namespace robosim {

/// Functions of libraries above the engine that runs may need.
struct StandardParts {
  MapReaders map_readers;
  ImageSourceMaker make_image_source = nullptr;
};

/// The library that contains robosimStandardParts(), and what subcommands without a network need besides the engine.
extern const char* const kProgramLibrary;
/// The Debian package of kProgramLibrary.
extern const char* const kProgramPackage;

/// A function of kProgramLibrary. The library's functions are bound when they are called, as those of one that is
/// linked: to bind all at once takes longer than to load it.
/// @throws ConfigError if this installation lacks the library
template <typename Function>
Function programFunction(const char* name) {
  try {
    return loadedFunction<Function>(kProgramLibrary, name, RTLD_LAZY);
  } catch (const std::runtime_error& error) {
    throw ConfigError("cannot load the library for maps, recordings, pictures and replays (" +
                      std::string(error.what()) + "); install the package " + kProgramPackage + ", or RoboSim again");
  }
}

/// Lets this program read maps and render cameras, as useStandardParts() does (run/outputs/standard_parts.h), but loads
/// the libraries for this, which need MRPT's observations and OpenCV, when the first map is read or the first camera
/// is made. To be called before the first world is read; robosimMain() calls it.
void useLoadedParts();

}  // namespace robosim

/// In kProgramLibrary.
extern "C" robosim::StandardParts robosimStandardParts();
