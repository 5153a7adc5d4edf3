#include <filesystem>

#include <dlfcn.h>

#include "robosim/bench_ray_caster.h"

namespace robosim {

std::unique_ptr<RayCaster> makeEmbreeCaster(const RayScene& rays, std::string& why_not) {
  const auto module = std::filesystem::read_symlink("/proc/self/exe").parent_path() / kEmbreeModule;
  if (!std::filesystem::exists(module)) {
    why_not = "RoboSim was built without it; install libembree-dev and build again";
    return nullptr;
  }
  // Never closed: what it made may live as long as the program.
  void* loaded = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = loaded ? dlsym(loaded, kEmbreeFunction) : nullptr;
  if (!function) {
    why_not = dlerror();
    return nullptr;
  }
  return std::unique_ptr<RayCaster>(reinterpret_cast<RayCaster* (*)(const RayScene&)>(function)(rays));
}

}  // namespace robosim
