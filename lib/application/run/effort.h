#pragma once
#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

#include "run/observer.h"

namespace robosim {

struct EffortOptions {
  double cell_m = 0.5;           ///< width of the square cells in which visits are counted
  double standing_w = 15;        ///< power of a robot that stands
  double driving_j_per_m = 7.4;  ///< further energy for each metre driven
};

/// What a search costs: energy, traffic of messages, and cells that several robots visit. The energy of a robot is
/// linear in time and distance, the form that Mei, Lu, Hu & Lee ("A case study of mobile robot's energy consumption and
/// conservation techniques", ICAR 2005) fit to a Pioneer 3-DX; turning on the spot costs only time. The defaults are of
/// the size of that robot with an embedded computer, sonars and wheels on a level floor.
class Effort : public Observer {
 public:
  explicit Effort(const EffortOptions& options) : options_(options) {}

  void observe(const Environment& environment) override;
  /// energy_wh: of all robots, from the start to the last step; message_bytes: delivered texts; visited_m2: area of the
  /// cells that some robot's centre has visited; overlap: of all visits of a cell by a robot, the share beyond the
  /// first robot in each cell, [0, 1).
  std::vector<Metric> metrics() const override;
  std::unique_ptr<Observer> clone(const ObserverSetup&) const override { return std::make_unique<Effort>(*this); }

 private:
  EffortOptions options_;
  double robot_seconds_s_ = 0;  ///< of the robots present
  double driven_m_ = 0;
  std::uint64_t message_bytes_ = 0;
  std::vector<std::unordered_set<std::uint64_t>> visited_;  ///< cells, by robot
};

ObserverType effortType();

}  // namespace robosim
