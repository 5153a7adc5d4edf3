#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim_bench/rounds.h"

namespace robosim {

/// RoboSim and Enki on the workload `infrared`, measured alternately on one machine.
struct EnkiFigures {
  std::size_t robots = 0;
  Cost robot_step;  ///< RoboSim's
  Cost peer_robot_step;
  double ratio() const { return peer_robot_step.cpu_s / robot_step.cpu_s; }
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnkiFigures, robots, robot_step, peer_robot_step)

struct EnkiBench {
  std::string why_no_peer;  ///< empty if Enki was measured
  std::vector<EnkiFigures> figures;
};

/// Maximum number of robots compared with Enki, which tests all pairs of objects in each step.
constexpr std::size_t kMaxBesideEnki = 1000;

/// Compares RoboSim with Enki, one thread each, for numbers of robots up to kMaxBesideEnki. Enki runs in a separate
/// process, `robosim_enki` in this program's folder, which is built if libenki-dev is found.
/// @throws std::runtime_error when that process ends early
EnkiBench benchEnki(const std::vector<std::size_t>& robots, std::uint64_t seed, double min_s);

}  // namespace robosim
