#include "robosim/bench_rays.h"

#include <algorithm>

#include "robosim/bench_process.h"
#include "robosim/bench_ray_caster.h"
#include "robosim/bench_ray_truth.h"
#include "robosim/text.h"

namespace robosim {
namespace {

constexpr std::size_t kPlaces = 250;

struct Way {
  const char* what;
  const char* peer_call;
  void (RayCaster::*cast)(double range_m);
  const RayTruth& truth;
};

void compare(RayCaster& caster, const Way& way, double range_m, double tolerance_m) {
  (caster.*way.cast)(range_m);
  for (std::size_t i = 0; i < way.truth.size(); ++i) {
    if (way.truth.agrees(i, caster.distance(i), range_m, tolerance_m)) continue;
    throw std::runtime_error(caster.name() + ": of the " + way.what + " to " + fixed(range_m, 0) + " m, ray " +
                             std::to_string(i) + " goes " + fixed(caster.distance(i), 10) + " m; by brute force " +
                             fixed(std::min(way.truth.distance(i), range_m), 10) + " m");
  }
}

Contender contender(RayCaster& caster, const Way& way, double range_m) {
  return {.work = [&caster, &way, range_m] {
    (caster.*way.cast)(range_m);
    return static_cast<double>(way.truth.size());
  }};
}

RayBench benchHere(std::uint64_t seed, double least_s) {
  const RayScene scene = makeRayScene(kPlaces, seed);
  const auto ours = makeSceneCaster(scene);
  RayBench bench;
  const auto peer = makeEmbreeCaster(scene, bench.why_no_peer);
  if (peer) bench.peer = peer->name();

  const RayTruth beams(scene.solids, scene.beams);
  const RayTruth singles(scene.solids, scene.singles);
  const Way ways[] = {{"scans", "rtcIntersect16, coherent", &RayCaster::castScans, beams},
                      {"single rays", "rtcIntersect1", &RayCaster::castSingles, singles}};
  for (const auto& way : ways) {
    for (const double range_m : {8.0, 20.0}) {
      std::vector<Contender> contenders{contender(*ours, way, range_m)};
      compare(*ours, way, range_m, 1e-9);
      bench.answers += way.truth.size();
      if (peer) {
        contenders.push_back(contender(*peer, way, range_m));
        compare(*peer, way, range_m, 1e-3);
      }
      const auto costs = takeTurns(contenders, least_s);
      bench.figures.push_back({.what = way.what,
                               .peer_call = way.peer_call,
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

RayBench benchRays(std::uint64_t seed, double least_s) {
  return inOwnProcess([&]() -> nlohmann::json { return benchHere(seed, least_s); });
}

}  // namespace robosim
