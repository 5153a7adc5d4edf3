#pragma once
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace robosim {

/// A function of a library that this program does not link, because loading it takes longer than most runs need to
/// start, or because an installation may lack it. The library stays loaded.
/// @param library file name, as in "librobosim-mpi.so.0.1"
/// @param mode of dlopen(). With RTLD_LAZY, a library of another version ends the program at the first call of a
/// function that it lacks; otherwise it is refused.
/// @throws std::runtime_error with the reason of dlerror()
template <typename Function>
Function loadedFunction(const std::string& library, const char* name, int mode = RTLD_NOW) {
  void* const handle = dlopen(library.c_str(), mode);
  if (!handle) throw std::runtime_error(dlerror());
  const auto function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function) throw std::runtime_error(library + ": has no function " + name + "; install RoboSim again");
  return function;
}

}  // namespace robosim
