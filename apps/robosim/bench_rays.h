#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim/bench_rounds.h"

namespace robosim {

/// One way of casting rays to one range, by RoboSim and by a peer in turns.
struct RayFigures {
  static constexpr double kRaysPerPlace = 181;
  std::string what;       ///< "scans" or "single rays"
  std::string peer_call;  ///< what the peer does it with
  double range_m = 0;
  std::size_t places = 0;  ///< from each of which 181 rays go; of single rays, as many as 181 a place
  Cost ray;
  Cost peer_ray;  ///< nothing without a peer

  /// How many times as fast as the peer, by CPU time.
  double ratio() const { return peer_ray.cpu_s / ray.cpu_s; }
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RayFigures, what, peer_call, range_m, places, ray, peer_ray)

struct RayBench {
  std::string peer;  ///< its name and version; empty where there is none
  std::string why_no_peer;
  std::size_t answers = 0;  ///< of each caster that were compared with brute force
  double peak_rss_mb = 0;
  std::vector<RayFigures> figures;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RayBench, peer, why_no_peer, answers, peak_rss_mb, figures)

/// Casts scans and single rays to 8 m and to 20 m, one thread, beside Embree where that is to be had; and compares
/// every answer of both with brute force.
/// @throws std::runtime_error when an answer differs by more than 1e-9 m, or 1 mm from Embree's single precision
RayBench benchRays(std::uint64_t seed, double least_s);

}  // namespace robosim
