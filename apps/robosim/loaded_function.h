#pragma once
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace robosim {

/// A function of a library that this program does not link, because loading it takes longer than most runs need to
/// start, or because an installation may lack it. The library stays loaded.
/// @param library file name, as in "librobosim-mpi.so.0.1" @param scope RTLD_LOCAL or RTLD_GLOBAL
/// @throws std::runtime_error with the reason of dlerror()
template <typename Function>
Function loadedFunction(const std::string& library, const char* name, int scope = RTLD_LOCAL) {
  void* const handle = dlopen(library.c_str(), RTLD_NOW | scope);
  if (!handle) throw std::runtime_error(dlerror());
  const auto function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function) throw std::runtime_error(library + ": has no function " + name + "; install RoboSim again");
  return function;
}

}  // namespace robosim
