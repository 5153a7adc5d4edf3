#pragma once
#include "replay/file_functions.h"
#include "run/loaded_parts.h"

namespace robosim {

/// Loads the library at the first call.
inline const FileFunctions& fileFunctions() {
  static const FileFunctions functions = programFunction<decltype(&robosimFileFunctions)>("robosimFileFunctions")();
  return functions;
}

}  // namespace robosim
