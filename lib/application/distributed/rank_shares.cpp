#include "distributed/rank_shares.h"

#include <algorithm>
#include <cmath>

#include "environment/run_digest.h"

namespace robosim {
namespace {

constexpr double kTolerance = 1.05;  ///< of the longest time to the average

std::size_t roundedUp(std::size_t robot, std::size_t robots) {
  constexpr std::size_t kChunk = RunDigest::kRobotsPerChunk;
  return std::min(robots, (robot + kChunk - 1) / kChunk * kChunk);
}

}  // namespace

RobotRange intersection(RobotRange a, RobotRange b) {
  const RobotRange both{std::max(a.begin, b.begin), std::min(a.end, b.end)};
  return both.empty() ? RobotRange{} : both;
}

RobotRange hull(RobotRange a, RobotRange b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

RankShares RankShares::of(std::size_t robots, int ranks, bool first_needs_all) {
  const auto count = static_cast<std::size_t>(ranks);
  const bool by_chunks = RunDigest::chunkCountOf(robots) >= count;
  const auto border = [&](std::size_t rank) {
    if (!by_chunks) return robots * rank / count;
    return std::min(robots, RunDigest::chunkCountOf(robots) * rank / count * RunDigest::kRobotsPerChunk);
  };
  RankShares shares;
  shares.robots = robots;
  shares.first_needs_all = first_needs_all;
  for (std::size_t rank = 0; rank < count; ++rank) {
    const RobotRange home{border(rank), border(rank + 1)};
    shares.home.push_back(home);
    const RobotRange chunks{roundedUp(home.begin, robots), roundedUp(home.end, robots)};
    shares.digested.push_back(chunks.empty() ? RobotRange{} : chunks);
  }
  shares.work = shares.home;
  return shares;
}

void RankShares::addRobots(std::size_t robots_now) {
  // The first ranges that end with the last robot may be those of ranks before empty ones.
  const auto last_digested = std::find_if(digested.begin(), digested.end(),
                                          [&](RobotRange range) { return !range.empty() && range.end == robots; });
  last_digested->end = home.back().end = work.back().end = robots = robots_now;
}

RobotRange RankShares::needed(std::size_t rank) const {
  if (rank == 0 && first_needs_all) return {0, robots};
  return hull(home[rank], digested[rank]);
}

RobotRange RankShares::kept(std::size_t rank) const { return hull(needed(rank), work[rank]); }

std::vector<RobotRange> balancedWork(const std::vector<RobotRange>& work, const std::vector<BusyTime>& busy) {
  const std::size_t ranks = work.size();
  double all_work_s = 0, all_s = 0, longest_s = 0;
  for (const BusyTime& time : busy) {
    all_work_s += time.work_s;
    all_s += time.work_s + time.other_s;
    longest_s = std::max(longest_s, time.work_s + time.other_s);
  }
  const double average_s = all_s / static_cast<double>(ranks);
  if (!(all_work_s > 0) || longest_s <= kTolerance * average_s) return work;
  // Time that each rank has left for moves and sensors; scaled so that together it is what these have taken.
  std::vector<double> left_s;
  double all_left_s = 0;
  for (const BusyTime& time : busy) all_left_s += left_s.emplace_back(std::max(0.0, average_s - time.other_s));
  if (!(all_left_s > 0)) return work;

  std::vector<RobotRange> balanced = work;
  std::size_t from = 0;  // rank in whose present range the next border lies
  double before_s = 0;   // time of the present ranges before it
  double border_s = 0;   // time of all robots before the next border
  std::size_t begin = work[0].begin;
  for (std::size_t rank = 0; rank + 1 < ranks; ++rank) {
    border_s += left_s[rank] * all_work_s / all_left_s;
    while (from + 1 < ranks && before_s + busy[from].work_s <= border_s) before_s += busy[from++].work_s;
    const double part = busy[from].work_s > 0 ? std::min(1.0, (border_s - before_s) / busy[from].work_s) : 0;
    const auto length = static_cast<double>(work[from].end - work[from].begin);
    const auto wanted = work[from].begin + static_cast<std::size_t>(std::llround(std::max(0.0, part) * length));
    const std::size_t border = std::max(begin, (work[rank].end + wanted + 1) / 2);
    balanced[rank] = {begin, border};
    begin = border;
  }
  balanced.back() = {begin, work.back().end};
  return balanced;
}

}  // namespace robosim
