#include "robosim_bench/rays.h"

#include <algorithm>

#include "base/text_table.h"
#include "robosim_bench/process.h"
#include "robosim_bench/ray_caster.h"
#include "robosim_bench/ray_truth.h"

namespace robosim {
namespace {

constexpr std::size_t kPlaces = 250;

struct RayKind {
  const char* what;
  const char* peer_call;
  void (RayCaster::*cast)(double range_m);
  const RayTruth& truth;
};

void compare(RayCaster& caster, const RayKind& kind, double range_m, double tolerance_m) {
  (caster.*kind.cast)(range_m);
  for (std::size_t i = 0; i < kind.truth.size(); ++i) {
    if (kind.truth.agrees(i, caster.distance(i), range_m, tolerance_m)) continue;
    throw std::runtime_error(caster.name() + ": of the " + kind.what + " to " + fixed(range_m, 0) + " m, ray " +
                             std::to_string(i) + " has length " + fixed(caster.distance(i), 10) +
                             " m; by brute force " + fixed(std::min(kind.truth.distance(i), range_m), 10) + " m");
  }
}

Contender contender(RayCaster& caster, const RayKind& kind, double range_m) {
  return {.work = [&caster, &kind, range_m] {
    (caster.*kind.cast)(range_m);
    return static_cast<double>(kind.truth.size());
  }};
}

RayBench benchHere(std::uint64_t seed, double min_s) {
  const RayScene scene = makeRayScene(kPlaces, seed);
  const auto robosim_caster = makeSceneCaster(scene);
  RayBench bench;
  const auto peer = makeEmbreeCaster(scene, bench.why_no_peer);
  if (peer) bench.peer = peer->name();

  const RayTruth beams(scene.solids, scene.beams);
  const RayTruth singles(scene.solids, scene.singles);
  const RayKind kinds[] = {{"scans", "rtcIntersect16, coherent", &RayCaster::castScans, beams},
                           {"single rays", "rtcIntersect1", &RayCaster::castSingles, singles}};
  for (const auto& kind : kinds) {
    for (const double range_m : {8.0, 20.0}) {
      std::vector<Contender> contenders{contender(*robosim_caster, kind, range_m)};
      compare(*robosim_caster, kind, range_m, 1e-9);
      bench.answers += kind.truth.size();
      if (peer) {
        contenders.push_back(contender(*peer, kind, range_m));
        compare(*peer, kind, range_m, 1e-3);
      }
      const auto costs = measureAlternately(contenders, min_s);
      bench.figures.push_back({.what = kind.what,
                               .peer_call = kind.peer_call,
                               .range_m = range_m,
                               .places = kPlaces,
                               .ray = costs[0],
                               .peer_ray = peer ? costs[1] : Cost{}});
    }
  }
  bench.peak_rss_mb = Memory::now().peak_mb;
  return bench;
}

}  // namespace

RayBench benchRays(std::uint64_t seed, double min_s) {
  return runInChildProcess([&]() -> nlohmann::json { return benchHere(seed, min_s); });
}

}  // namespace robosim
