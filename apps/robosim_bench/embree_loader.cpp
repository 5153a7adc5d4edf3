#include <filesystem>

#include <dlfcn.h>

#include "base/program_folder.h"
#include "robosim_bench/ray_caster.h"

namespace robosim {

std::unique_ptr<RayCaster> makeEmbreeCaster(const RayScene& rays, std::string& why_not) {
  const auto module = programFolder() / kEmbreeModule;
  if (!std::filesystem::exists(module)) {
    why_not = "RoboSim was built without Embree; install libembree-dev and rebuild";
    return nullptr;
  }
  // Never closed: objects created by the module may live until the program ends.
  void* loaded = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = loaded ? dlsym(loaded, kEmbreeFunction) : nullptr;
  if (!function) {
    why_not = dlerror();
    return nullptr;
  }
  return std::unique_ptr<RayCaster>(reinterpret_cast<RayCaster* (*)(const RayScene&)>(function)(rays));
}

}  // namespace robosim
