#include "run/effort.h"

#include <cmath>
#include <numeric>

namespace robosim {
namespace {

/// A cell by its column and row, each of which may be negative.
std::uint64_t cellAt(double x_m, double y_m, double cell_m) {
  const auto index = [&](double m) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(m / cell_m)));
  };
  return std::uint64_t{index(x_m)} << 32 | index(y_m);
}

}  // namespace

void Effort::observe(const Environment& environment) {
  const State& state = environment.state();
  visited_.resize(state.world_from_robot.size());
  for (std::size_t i = 0; i < state.world_from_robot.size(); ++i) {
    if (state.activity[i] == Activity::absent) continue;
    if (state.time.step > 0) robot_seconds_s_ += state.time.period_s;
    const auto& pose = state.world_from_robot[i];
    visited_[i].insert(cellAt(pose.x, pose.y, options_.cell_m));
    for (const auto& message : state.readings[i].inbox) message_bytes_ += message.text.size();
  }
  driven_m_ = std::accumulate(state.driven_m.begin(), state.driven_m.end(), 0.0);
}

std::vector<Metric> Effort::metrics() const {
  std::unordered_set<std::uint64_t> cells;
  std::size_t visits = 0;
  for (const auto& of_robot : visited_) {
    visits += of_robot.size();
    cells.insert(of_robot.begin(), of_robot.end());
  }
  const double energy_j = options_.standing_w * robot_seconds_s_ + options_.driving_j_per_m * driven_m_;
  const auto count = static_cast<double>(cells.size());
  return {{"energy_wh", energy_j / 3600},
          {"message_bytes", static_cast<double>(message_bytes_)},
          {"visited_m2", count * options_.cell_m * options_.cell_m},
          {"overlap", visits == 0 ? 0 : 1 - count / static_cast<double>(visits)}};
}

ObserverType effortType() {
  return {"effort",
          "Energy, bytes of messages, and area visited by several robots.",
          {{"cell_m", EffortOptions{}.cell_m, 0.01, 1000, "m", "width of a cell in which visits are counted"},
           {"standing_w", EffortOptions{}.standing_w, 0, 1e6, "W", "power of a robot that stands"},
           {"driving_j_per_m", EffortOptions{}.driving_j_per_m, 0, 1e6, "J/m", "further energy for each metre driven"}},
          [](const ObserverSetup&, const ParameterValues& p) -> std::unique_ptr<Observer> {
            return std::make_unique<Effort>(EffortOptions{p["cell_m"], p["standing_w"], p["driving_j_per_m"]});
          }};
}

}  // namespace robosim
