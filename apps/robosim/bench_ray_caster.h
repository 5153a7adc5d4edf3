#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "robosim/bench_ray_scene.h"

namespace robosim {

/// One who casts the rays of a RayScene: RoboSim, or a peer. Made ready in its constructor, which is not timed.
class RayCaster {
 public:
  virtual ~RayCaster() = default;
  virtual std::string name() const = 0;
  /// Casts all beams of all scans, together as far as it can.
  virtual void castScans(double range_m) = 0;
  /// Casts all single rays, which have nothing in common, with a call for each.
  virtual void castSingles(double range_m) = 0;
  /// What ray `i` of the last cast met, in metres; the range when it met nothing.
  virtual double distance(std::size_t i) const = 0;
};

/// RoboSim: a batch a scan, and Scene::castRay().
std::unique_ptr<RayCaster> makeSceneCaster(const RayScene&);

/// Embree 3, or null where it is not to be had. It lives in a module of its own beside the program, which is loaded
/// here, so that the program does not need Embree.
/// @param why_not then says what is missing
std::unique_ptr<RayCaster> makeEmbreeCaster(const RayScene&, std::string& why_not);

/// The module's file, and the one function it offers: RayCaster* (const RayScene&).
constexpr const char* kEmbreeModule = "robosim_embree.so";
constexpr const char* kEmbreeFunction = "makeRobosimEmbreeCaster";

}  // namespace robosim
