#include "run/coverage.h"

#include <cmath>
#include <limits>

#include "base/text_table.h"

namespace robosim {
namespace {

/// Bounds the memory of a large surface with small cells.
constexpr double kCellsMax = 1e8;

std::size_t cellCount(double length_m, double cell_m) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / cell_m - 1e-9)));
}

std::size_t cellOf(double offset_m, double cell_m, std::size_t count) {
  const double cell = std::floor(offset_m / cell_m);
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

void Coverage::observe(const Environment& environment) {
  const auto& area = environment.world().bounds;
  if (visited_.empty()) {
    columns_ = cellCount(area.x_max - area.x_min, options_.cell_m);
    rows_ = cellCount(area.y_max - area.y_min, options_.cell_m);
    if (static_cast<double>(columns_) * static_cast<double>(rows_) > kCellsMax) {
      throw std::runtime_error("the surface has more than 100 million cells; use a larger cell_m");
    }
    visited_.assign(columns_ * rows_, 0);
  }
  const State& state = environment.state();
  for (std::size_t i = 0; i < state.world_from_robot.size(); ++i) {
    if (state.activity[i] == Activity::absent) continue;
    const auto& pose = state.world_from_robot[i];
    const std::size_t column = cellOf(pose.x - area.x_min, options_.cell_m, columns_);
    const std::size_t row = cellOf(pose.y - area.y_min, options_.cell_m, rows_);
    std::uint8_t& cell = visited_[row * columns_ + column];
    visited_count_ += cell == 0 ? 1 : 0;
    cell = 1;
  }
  if (!half_covered_s_ && coveredPercent() >= 50) half_covered_s_ = environment.time().seconds();
}

std::string Coverage::endReason() const {
  if (options_.end_percent <= 0 || coveredPercent() < options_.end_percent) return {};
  return fixed(coveredPercent(), 1) + " % covered";
}

std::vector<Metric> Coverage::metrics() const {
  return {{"covered_percent", coveredPercent()},
          {"half_covered_s", half_covered_s_.value_or(std::numeric_limits<double>::quiet_NaN())}};
}

double Coverage::coveredPercent() const {
  if (visited_.empty()) return 0;
  return 100 * static_cast<double>(visited_count_) / static_cast<double>(visited_.size());
}

ObserverType coverageType() {
  return {"coverage",
          "The share of the surface that robots have visited, in square cells.",
          {{"cell_m", CoverageOptions{}.cell_m, 0.01, 1000, "m", "width of a cell"},
           {"end_percent", CoverageOptions{}.end_percent, 0, 100, "%", "ends the run at this share; 0: never"}},
          [](const ObserverSetup&, const ParameterValues& p) -> std::unique_ptr<Observer> {
            return std::make_unique<Coverage>(CoverageOptions{p["cell_m"], p["end_percent"]});
          }};
}

}  // namespace robosim
