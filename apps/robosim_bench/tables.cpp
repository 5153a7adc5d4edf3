#include "robosim_bench/tables.h"

#include "base/text_table.h"
#include "robosim_bench/process.h"

namespace robosim {
namespace {

double raysPerSecond(const RobotFigures& f) { return static_cast<double>(f.rays) / f.robot_step.wall_s; }

/// Fields common to all lines.
nlohmann::ordered_json line(const std::string& workload, std::size_t robots, int threads, const Cost& robot_step,
                            double rays_per_s, double peak_rss_mb) {
  return {{"workload", workload},      {"robots", robots},
          {"threads", threads},        {"robot_steps_per_s", 1 / robot_step.wall_s},
          {"rays_per_s", rays_per_s},  {"cpu_s_per_robot_step", robot_step.cpu_s},
          {"peak_rss_mb", peak_rss_mb}};
}

}  // namespace

nlohmann::ordered_json toJson(const RobotFigures& f) {
  auto json = line(f.workload, f.robots, f.threads, f.robot_step, raysPerSecond(f), f.peak_rss_mb);
  json["make_s"] = f.make_s;
  json["digest"] = f.digest;
  return json;
}

std::vector<nlohmann::ordered_json> toJsonLines(const RayBench& bench) {
  std::vector<nlohmann::ordered_json> lines;
  for (const auto& f : bench.figures) {
    const Cost place{f.ray.wall_s * RayFigures::kRaysPerPlace, f.ray.cpu_s * RayFigures::kRaysPerPlace};
    auto json = line(kRays, f.places, 1, place, 1 / f.ray.wall_s, bench.peak_rss_mb);
    json["cast"] = f.what;
    json["range_m"] = f.range_m;
    if (!bench.peer.empty()) {
      json["peer"] = bench.peer;
      json["peer_rays_per_s"] = 1 / f.peer_ray.wall_s;
      json["times_peer"] = f.ratio();
    }
    lines.push_back(std::move(json));
  }
  return lines;
}

std::vector<nlohmann::ordered_json> toJsonLines(const EnkiBench& bench) {
  std::vector<nlohmann::ordered_json> lines;
  for (const auto& f : bench.figures) {
    auto json = line(kEnki, f.robots, 1, f.robot_step, 0, Memory::now().peak_mb);
    json["peer"] = "Enki";
    json["peer_cpu_s_per_robot_step"] = f.peer_robot_step.cpu_s;
    json["times_peer"] = f.ratio();
    lines.push_back(std::move(json));
  }
  return lines;
}

std::string toTable(const EnkiBench& bench) {
  if (!bench.why_no_peer.empty()) return "Not compared with Enki: " + bench.why_no_peer + ".\n";
  Rows rows{{"infrared, one thread", "robot-steps/CPU s", "Enki", "ratio"}};
  for (const auto& f : bench.figures) {
    const auto rate = [](const Cost& cost) { return withCommas(static_cast<std::uint64_t>(1 / cost.cpu_s)); };
    rows.push_back(
        {withCommas(f.robots) + " robots", rate(f.robot_step), rate(f.peer_robot_step), fixed(f.ratio(), 1)});
  }
  return table(rows) + "Enki also computes contacts; its sensors of three rays each give 24 rays per robot, as here.\n";
}

std::string toTable(const std::vector<RobotFigures>& loads) {
  Rows rows{{"workload", "robots", "threads", "robot-steps/s", "robot-steps/CPU s", "Mrays/s", "CPU µs/robot-step",
             "peak MB", "creation [s]"}};
  for (const auto& f : loads) {
    rows.push_back({f.workload, withCommas(f.robots), std::to_string(f.threads),
                    withCommas(static_cast<std::uint64_t>(1 / f.robot_step.wall_s)),
                    withCommas(static_cast<std::uint64_t>(1 / f.robot_step.cpu_s)),
                    raysPerSecond(f) > 0 ? fixed(raysPerSecond(f) * 1e-6, 1) : "–", fixed(f.robot_step.cpu_s * 1e6, 2),
                    fixed(f.peak_rss_mb, 0), fixed(f.make_s, 2)});
  }
  return table(rows);
}

std::string toTable(const RayBench& bench) {
  const bool peer = !bench.peer.empty();
  Rows rows{{"rays, one thread", "Mrays/CPU s", peer ? bench.peer : "", peer ? "ratio" : "", ""}};
  for (const auto& f : bench.figures) {
    rows.push_back({f.what + " to " + fixed(f.range_m, 0) + " m", fixed(1e-6 / f.ray.cpu_s, 1)});
    if (peer)
      rows.back().insert(rows.back().end(), {fixed(1e-6 / f.peer_ray.cpu_s, 1), fixed(f.ratio(), 2), f.peer_call});
  }
  return table(rows) + withCommas(bench.answers) + (peer ? " results of each" : " results") + " equal brute force.\n" +
         (peer ? "" : "Not compared with Embree 3: " + bench.why_no_peer + ".\n");
}

std::string toTable(const std::vector<Target>& targets) {
  Rows rows{{"figure", "target", "measured", "met"}};
  for (const auto& t : targets) rows.push_back({t.what, t.target, t.measured, t.met ? (*t.met ? "yes" : "no") : "–"});
  return table(rows);
}

}  // namespace robosim
