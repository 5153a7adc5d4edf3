#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "run/observer.h"

namespace robosim {

struct CoverageOptions {
  double cell_m = 0.5;     ///< width of the square cells of the surface
  double end_percent = 0;  ///< ends the run when so many cells were visited; 0: never
};

/// How much of the surface the robots' centres have visited. Cells that lie inside obstacles count as not visited, so
/// that 100 % may be out of reach.
class Coverage : public Observer {
 public:
  explicit Coverage(const CoverageOptions& options) : options_(options) {}

  void observe(const Environment& environment) override;
  std::string endReason() const override;
  /// covered_percent; half_covered_s: when 50 % were reached.
  std::vector<Metric> metrics() const override;
  std::unique_ptr<Observer> clone(const ObserverSetup&) const override { return std::make_unique<Coverage>(*this); }

 private:
  double coveredPercent() const;

  CoverageOptions options_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> visited_;  ///< by cell, row by row
  std::size_t visited_count_ = 0;
  std::optional<double> half_covered_s_;
};

ObserverType coverageType();

}  // namespace robosim
