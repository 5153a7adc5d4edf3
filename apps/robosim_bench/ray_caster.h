#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "robosim_bench/ray_scene.h"

namespace robosim {

/// Interface of the compared ray casters: RoboSim and its peers. The constructor, which builds the index, is not timed.
class RayCaster {
 public:
  virtual ~RayCaster() = default;
  virtual std::string name() const = 0;
  /// Casts all beams of all scans, in batches where possible.
  virtual void castScans(double range_m) = 0;
  /// Casts all single rays, one call for each.
  virtual void castSingles(double range_m) = 0;
  /// Distance [m] that the last cast returned for ray `i`; the range if it hit nothing.
  virtual double distance(std::size_t i) const = 0;
};

/// RoboSim: one batch per scan, and Scene::castRay() for single rays.
std::unique_ptr<RayCaster> makeSceneCaster(const RayScene&);

/// Embree 3, or null where it is not available. Loaded at run time from a module in the program's folder, so that the
/// program does not depend on Embree.
/// @param why_not receives the reason if null is returned
std::unique_ptr<RayCaster> makeEmbreeCaster(const RayScene&, std::string& why_not);

/// File name of the module, and its only exported function: RayCaster* (const RayScene&).
constexpr const char* kEmbreeModule = "robosim_embree.so";
constexpr const char* kEmbreeFunction = "makeRobosimEmbreeCaster";

}  // namespace robosim
