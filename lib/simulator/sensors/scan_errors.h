#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "base/random_blocks.h"
#include "base/ziggurat.h"
#include "sensors/beam_footprint.h"
#include "sensors/laser_errors.h"
#include "sensors/sensor.h"

namespace robosim {

/// Applies a LaserErrors to the beams of scans. Each beam draws its own random numbers, whatever it hits.
class ScanErrors {
 public:
  /// Most beams of a scan with errors: a random number that requires further bits has 2^16 blocks of its own.
  static constexpr std::size_t kBeamsMax = 32'768;

  /// @param info specifies the ranges
  ScanErrors(const LaserErrors& errors, const SensorInfo& info)
      : errors_(errors), process_(errors, info), range_max_m_(info.range_max_m) {}

  bool areNone() const { return errors_ == LaserErrors(); }

  /// Replaces the distances of a robot's scan by readings, infinite for lost echoes.
  /// @param return_of returns the light that returns to beam i: return_of(i, distortion), where distortion() draws the
  /// random error of a mixed pixel's shares in standard deviations
  template <typename ReturnOf>
  void apply(const Snapshot& now, std::uint32_t robot, std::size_t slot, std::vector<double>& distance_m,
             const ReturnOf& return_of) const {
    // On the heap, because the compiler treats each access to a thread's variable as a call, around which it spills the
    // registers of its loops.
    static thread_local const auto memory = std::make_unique<Memory>();
    RandomBlocks& random = memory->random;
    std::vector<double>& read_m = memory->read_m;
    constexpr double kUnit = 0x1p-32;
    const double drift_m = errors_.driftAt(now.time.seconds());
    const auto item = static_cast<std::uint32_t>(slot);
    const std::size_t beams = distance_m.size();
    random.draw(now.seed, RandomPurpose::sensor_noise, robot, item, now.time.step, beams);
    const Ziggurat& ziggurat = Ziggurat::instance();
    read_m.resize(beams);
    for (std::size_t i = 0; i < beams; ++i) {
      const auto gaussian = [&](std::uint32_t word, std::uint32_t number) {
        return ziggurat.gaussian(word, [&] {
          Rng rng(now.seed, RandomPurpose::sensor_retry, robot, item, now.time.step);
          rng.skipToBlock(static_cast<std::uint32_t>(2 * i + number) << 16);
          return rng;
        });
      };
      BeamDraw draw{.event = random.words[0][i] * kUnit, .other = (random.words[1][i] + 0.5) * kUnit};
      const Return echo = return_of(i, [&] { return gaussian(random.words[3][i], 1); });
      if (!(echo.range_m < range_max_m_)) {
        read_m[i] = std::numeric_limits<double>::infinity();
        continue;
      }
      draw.gaussian = gaussian(random.words[2][i], 0);
      read_m[i] = process_.readingOf(echo.range_m, echo.power, drift_m, draw);
    }
    distance_m.swap(read_m);
  }

 private:
  /// Of one scan.
  struct Memory {
    RandomBlocks random;
    std::vector<double> read_m;
  };

  LaserErrors errors_;
  ErrorProcess process_;
  double range_max_m_;
};

}  // namespace robosim
