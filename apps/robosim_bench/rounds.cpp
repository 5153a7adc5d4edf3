#include "robosim_bench/rounds.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "base/seconds.h"

namespace robosim {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

Cost oneRound(const Contender& contender, double min_s) {
  Cost spent;
  double units = 0;
  do {
    contender.prepare();
    const Clocks start = contender.clocks();
    units += contender.work();
    const Clocks end = contender.clocks();
    spent.wall_s += end.wall_s - start.wall_s;
    spent.cpu_s += end.cpu_s - start.cpu_s;
  } while (spent.wall_s < min_s);
  return {spent.wall_s / units, spent.cpu_s / units};
}

}  // namespace

Clocks Clocks::now() {
  timespec cpu{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  return {toSeconds(std::chrono::steady_clock::now().time_since_epoch()),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

std::vector<Cost> measureAlternately(std::span<const Contender> contenders, double min_s) {
  std::vector<std::vector<double>> wall_s(contenders.size());
  std::vector<std::vector<double>> cpu_s(contenders.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const Cost cost = oneRound(contenders[i], min_s / kRounds);
      wall_s[i].push_back(cost.wall_s);
      cpu_s[i].push_back(cost.cpu_s);
    }
  }
  std::vector<Cost> medians;
  for (std::size_t i = 0; i < contenders.size(); ++i) medians.push_back({median(wall_s[i]), median(cpu_s[i])});
  return medians;
}

}  // namespace robosim
