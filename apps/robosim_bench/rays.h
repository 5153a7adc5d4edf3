#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim_bench/rounds.h"

namespace robosim {

/// One kind of ray casting at one range, by RoboSim and by a peer alternately.
struct RayFigures {
  static constexpr double kRaysPerPlace = 181;
  std::string what;       ///< "scans" or "single rays"
  std::string peer_call;  ///< the peer's function
  double range_m = 0;
  std::size_t places = 0;  ///< origins of 181 rays each; single rays: 181 per place
  Cost ray;
  Cost peer_ray;  ///< 0 without a peer

  /// Speed relative to the peer, by CPU time.
  double ratio() const { return peer_ray.cpu_s / ray.cpu_s; }
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RayFigures, what, peer_call, range_m, places, ray, peer_ray)

struct RayBench {
  std::string peer;  ///< name and version; empty if not available
  std::string why_no_peer;
  std::size_t answers = 0;  ///< results of each caster that were compared with brute force
  double peak_rss_mb = 0;
  std::vector<RayFigures> figures;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RayBench, peer, why_no_peer, answers, peak_rss_mb, figures)

/// Casts scans and single rays to 8 m and to 20 m, one thread, alternately with Embree where available; compares every
/// result of both with brute force.
/// @throws std::runtime_error when a result differs by more than 1e-9 m, or 1 mm for Embree's single precision
RayBench benchRays(std::uint64_t seed, double min_s);

}  // namespace robosim
