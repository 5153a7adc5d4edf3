// The part of DistributedRun about the robots that each rank knows.
#include <algorithm>
#include <utility>

#include "base/text_table.h"
#include "distributed/distributed_run.h"
#include "distributed/rank_bytes.h"
#include "environment/known_robots.h"
#include "environment/step_phases.h"

namespace robosim {
namespace {

/// Of the robots of other ranks, the share that ranks may know on average. Beyond, an exchange with all is as cheap.
constexpr double kKnownShareMax = 0.5;

}  // namespace

void DistributedRun::chooseExchange() {
  const Environment& environment = run_->environment();
  const auto interaction = Interaction::of(environment.world(), environment.fleet(), environment.time().period_s);
  std::string reason = interaction.unlimited_by;
  if (distribution_.exchange == RankExchange::all) reason = "as requested";
  if (!environment.state().object_speeds.empty()) reason = "robots may push objects";
  if (!environment.world().timeline.empty()) reason = "the world file changes the world during the run";
  if (has_supervisors_) reason = "an observer may change the run";
  if (shares_.ranks() == 1) reason = "there is one rank";
  if (reason.empty()) {
    near_ = std::make_unique<NearRobots>(environment.world().bounds, shares_.robots, interaction);
    findKnownRobots();
    const double of_others = gatherKnownShare();
    const std::string share = fixed(100 * of_others, 1) + " % of the robots of other ranks are within " +
                              fixed(near_->reach(), 1) + " m of a rank's own" +
                              (firstNeedsAll() ? " (without rank 0, which needs all)" : "");
    if (distribution_.exchange == RankExchange::near || of_others <= kKnownShareMax) {
      exchange_text_ = "ranks know the robots near their own: " + share + ", which is renewed every " +
                       std::to_string(near_->steps()) + " steps";
      return limitToKnownRobots();
    }
    reason = share;
  }
  near_.reset();
  known_ = {};
  exchange_text_ = "ranks know all robots: " + reason;
  orders_of_ = {listOf(shares_.home[own_])};  // setWork() sets the other
}

double DistributedRun::gatherKnownShare() {
  StateWriter own;
  own.addNumber(static_cast<std::uint64_t>(known_.size()));
  out_ = std::move(own.bytes);
  allGather();
  std::uint64_t known = 0, others = 0;
  for (std::size_t rank = firstNeedsAll() ? 1 : 0; rank < shares_.ranks(); ++rank) {
    const std::size_t work = shares_.work[rank].end - shares_.work[rank].begin;
    readRankBytes(all_[rank], "numbers", [&](StateReader& in) { known += in.takeNumber<std::uint64_t>() - work; });
    others += shares_.robots - work;
  }
  return others == 0 ? 0 : static_cast<double>(known) / static_cast<double>(others);
}

void DistributedRun::findKnownRobots() {
  Environment& environment = run_->environment();
  const MotionState motion = environment.phases().motion();
  out_ = near_->areaOf(motion.world_from_robot, shares_.work[own_]);
  finished(moves);
  allGather();
  finished(waiting);
  const auto known_of = [&](RobotRange robots) {
    return near_->neededBy(motion.world_from_robot, robots, all_, shares_, own_, firstNeedsAll());
  };
  motion_of_ = known_of(shares_.work[own_]);
  orders_of_ = shares_.home[own_] == shares_.work[own_] ? motion_of_ : known_of(shares_.home[own_]);
  for (std::size_t rank = 0; rank < to_.size(); ++rank) {
    to_[rank].clear();
    writeMotion(motion, environment.phases().orders(), motion_of_[rank], to_[rank]);
  }
  finished(moves);
  exchange();
  finished(waiting);
  known_ = readMotionOfOthers(shares_.work);
  const std::vector<std::uint32_t> own = listOf(shares_.work[own_]);
  if (!own.empty()) known_.insert(std::lower_bound(known_.begin(), known_.end(), own[0]), own.begin(), own.end());
}

std::vector<std::uint32_t> DistributedRun::readMotionOfOthers(const std::vector<RobotRange>& of_rank) {
  Environment& environment = run_->environment();
  std::vector<std::uint32_t> robots;
  for (std::size_t rank = 0; rank < shares_.ranks(); ++rank) {
    if (rank != own_)
      readMotion(all_[rank], of_rank[rank], environment.phases().motion(), environment.phases().orders(), robots);
  }
  return robots;
}

void DistributedRun::limitToKnownRobots() {
  const bool knows_all = own_ == 0 && firstNeedsAll();
  run_->environment().phases().limitTo(known_, knows_all ? RobotRange{0, shares_.robots} : shares_.work[own_]);
  near_until_step_ = run_->environment().time().step + near_->steps();
  finished(moves);
}

void DistributedRun::exchangeMovedShares(const std::vector<RobotRange>& before,
                                         const std::vector<RobotRange>& kept_before) {
  Environment& environment = run_->environment();
  for (std::size_t rank = 0; rank < shares_.ranks(); ++rank) {
    to_[rank].clear();
    if (rank == own_) continue;
    const RobotRange sent = intersection(before[own_], shares_.kept(rank));
    std::vector<std::uint32_t> robots = listOf(sent);
    std::erase_if(robots, [&](std::uint32_t robot) { return kept_before[rank].contains(robot); });
    writeMotion(environment.phases().motion(), environment.phases().orders(), robots, to_[rank]);
  }
  finished(rest);
  exchange();
  finished(waiting);
  readMotionOfOthers(before);
}

void DistributedRun::exchangeWinCandidates() {
  Environment& environment = run_->environment();
  // The requests are the same on all ranks.
  if (!near_ || environment.state().winner() || !anyFlag(environment.phases().orders().win_requests)) return;
  std::vector<std::uint32_t> candidates = listOf(shares_.work[own_]);
  std::erase_if(candidates, [&](std::uint32_t robot) { return !environment.phases().orders().win_requests[robot]; });
  out_.clear();
  writeMotion(environment.phases().motion(), environment.phases().orders(), candidates, out_);
  finished(rest);
  allGather();
  finished(waiting);
  readMotionOfOthers(shares_.work);
}

void DistributedRun::gatherMotion() {
  Environment& environment = run_->environment();
  const MotionState motion = environment.phases().motion();
  StateWriter own;
  own.addNumber(motion.stalls);
  out_ = std::move(own.bytes);
  writeMotion(motion, environment.phases().orders(), listOf(shares_.work[own_]), out_);
  group_.gather(out_, all_);
  if (own_ > 0) return;
  for (std::size_t rank = 1; rank < shares_.ranks(); ++rank) {
    const auto counted = std::string_view(all_[rank]).substr(0, sizeof motion.stalls);
    std::uint64_t stalls = 0;
    readRankBytes(counted, "numbers", [&](StateReader& in) { stalls = in.takeNumber<std::uint64_t>(); });
    if (!firstNeedsAll()) motion.stalls += stalls;
    all_[rank].erase(0, counted.size());
  }
  readMotionOfOthers(shares_.work);
}

}  // namespace robosim
