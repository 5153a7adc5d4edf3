#include "server/result_samples.h"

#include <algorithm>
#include <cmath>

#include "base/digest.h"
#include "environment/step_phases.h"

namespace robosim {
namespace {

std::vector<Measurement> copyMeasurements(const Environment& environment, std::size_t robot) {
  std::vector<Measurement> measurements;
  const auto& sensors = environment.fleet().robots[robot].model->sensors;
  for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
    if (sensors[slot]->sensesInHostProcess()) continue;
    measurements.push_back(environment.state().readings[robot].measurements[slot]);
  }
  return measurements;
}

}  // namespace

std::vector<ResultSamples::Expected> ResultSamples::compute(Environment& environment, RobotRange share,
                                                            std::uint64_t worker) const {
  const std::size_t robots = share.end - share.begin;
  const auto requested = static_cast<std::size_t>(std::ceil(fraction_ * static_cast<double>(robots)));
  const std::size_t count = std::clamp<std::size_t>(requested, 1, robots);
  Digest digest;
  for (const std::uint64_t number : {secret_, worker, environment.time().step}) digest.add(number);
  // A random first robot gives each robot of the share the same probability.
  const std::size_t first = static_cast<std::size_t>(digest.value() % robots);
  std::vector<Expected> sample;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t robot = share.begin + (first + k) % robots;
    environment.phases().sense({robot, robot + 1});
    sample.push_back({robot, copyMeasurements(environment, robot)});
  }
  return sample;
}

std::optional<std::size_t> ResultSamples::firstDifference(const std::vector<Expected>& sample,
                                                          const Environment& environment) {
  for (const auto& expected : sample) {
    if (copyMeasurements(environment, expected.robot) != expected.measurements) return expected.robot;
  }
  return std::nullopt;
}

}  // namespace robosim
