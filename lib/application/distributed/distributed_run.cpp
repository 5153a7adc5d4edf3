#include "distributed/distributed_run.h"

#include <chrono>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <sys/resource.h>
#include <time.h>

#include "base/seconds.h"
#include "distributed/rank_bytes.h"
#include "distributed/ranks/agreement.h"
#include "distributed/run_identity.h"
#include "environment/intervention_bytes.h"
#include "environment/step_phases.h"

namespace robosim {
namespace {

double secondsNow() { return toSeconds(std::chrono::steady_clock::now().time_since_epoch()); }

/// Processor time of this process [s]; other programs on a shared machine do not change it much.
double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Calls a function. @return its exception; null for none
template <typename Function>
std::exception_ptr failureOf(const Function& function) {
  try {
    function();
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

/// Whether a range of one rank and one of another have robots in common.
bool overlapOtherRanks(const std::vector<RobotRange>& from, const std::vector<RobotRange>& to) {
  for (std::size_t p = 0; p < from.size(); ++p) {
    for (std::size_t q = 0; q < to.size(); ++q) {
      if (p != q && !intersection(from[p], to[q]).empty()) return true;
    }
  }
  return false;
}

}  // namespace

DistributedRun::DistributedRun(RankGroup& group, LoadedWorld world, RunOptions options,
                               const DistributionOptions& distribution)
    : group_(group),
      shares_(RankShares::of(world.fleet.robots.size(), group.size(), distribution.first_needs_readings)),
      distribution_(distribution),
      own_(static_cast<std::size_t>(group.rank())),
      has_observers_(!options.observers.empty()),
      has_supervisors_(anySupervises(options.observers)),
      to_(shares_.ranks()),
      last_s_(secondsNow()) {
  for (std::size_t rank = 0; rank < shares_.ranks(); ++rank) needed_.push_back(shares_.needed(rank));
  const RunOptions given = options;
  if (own_ > 0) options.observers.clear();
  options.environment.share = RobotShare{shares_.kept(own_), shares_.digested[own_]};
  std::vector<std::uint8_t> elsewhere(shares_.robots, 1);
  for (std::size_t i = shares_.home[own_].begin; i < shares_.home[own_].end; ++i) elsewhere[i] = 0;
  options.is_added_elsewhere = [this](const FleetRobot&) { return own_ + 1 < shares_.ranks(); };
  options.checks_added_elsewhere = true;
  std::string identity;
  agree(group_, [&] {
    run_ = std::make_unique<LocalRun>(std::move(world), options, elsewhere);
    identity = describeIdentity(*run_->environment().model(), given, distribution_);
  });

  group_.allGather(identity, all_);
  agree(group_, [&] { requireSameRun(all_[own_], all_[0]); });
  chooseExchange();
  setWork(shares_.work);
  measured_ = {};
  busy_ = {};
  last_s_ = secondsNow();
  last_processor_s_ = processorSeconds();
  observe();  // observers may end the run before its first step
}

void DistributedRun::setWork(const std::vector<RobotRange>& work) {
  shares_.work = work;
  sends_readings_ = overlapOtherRanks(work, needed_);
  if (!near_) motion_of_ = {listOf(work[own_])};
}

void DistributedRun::followAdditions() {
  Environment& environment = run_->environment();
  if (environment.robotCount() == shares_.robots) return;
  shares_.addRobots(environment.robotCount());
  for (std::size_t rank = 0; rank < shares_.ranks(); ++rank) needed_[rank] = shares_.needed(rank);
  environment.phases().keepReadings(shares_.kept(own_));
  environment.phases().digest(shares_.digested[own_]);
  orders_of_ = {listOf(shares_.home[own_])};
  setWork(shares_.work);
}

void DistributedRun::step(bool is_end_requested, const std::exception_ptr& failure,
                          const std::function<void()>& record) {
  Environment& environment = run_->environment();
  finished(rest);
  if (near_ && environment.time().step == near_until_step_) {
    findKnownRobots();
    limitToKnownRobots();
  }
  exchangeOrders(failure);
  environment.phases().begin();
  followAdditions();
  finished(moves);
  environment.phases().clip(shares_.work[own_]);
  finished(clips);
  exchangePaths();
  environment.phases().judge(shares_.work[own_]);
  finished(judgements);
  exchangeStays(is_end_requested);
  environment.phases().move();
  measured_.robots_moved += near_ ? known_.size() : shares_.robots;
  finished(moves);
  own_failure_ = failureOf([&] { environment.phases().senseFully(shares_.work[own_]); });
  finished(sensors);
  if (sends_readings_) exchangeReadings(shares_.work, needed_);
  exchangeWinCandidates();
  environment.phases().conclude();
  const std::exception_ptr observer_failure = failureOf([&] { run_->observe(record); });
  finished(rest);
  if (has_observers_) {
    group_.allGather(errorBytes(observer_failure), all_);
    throwFirstError(group_, {all_.begin(), all_.end()}, observer_failure);
    observe();
  } else if (observer_failure) {
    own_failure_ = observer_failure;
  }
  ++measured_.steps;
  if (distribution_.balance_steps > 0 && measured_.steps % distribution_.balance_steps == 0) balance();
}

void DistributedRun::allGather() {
  measured_.bytes_sent += out_.size();
  group_.allGather(out_, all_);
  countReceived(all_);
}

void DistributedRun::exchange() {
  for (const auto& bytes : to_) measured_.bytes_sent += bytes.size();
  group_.exchange(to_, all_);
  countReceived(all_);
}

void DistributedRun::exchangeAndGather() {
  for (const auto& bytes : to_) measured_.bytes_sent += bytes.size();
  measured_.bytes_sent += out_.size();
  group_.exchangeAndGather(to_, out_, from_, all_);
  countReceived(from_);
  countReceived(all_);
}

void DistributedRun::countReceived(const std::vector<std::string>& by_rank) {
  for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
    if (rank != own_) measured_.bytes_received += by_rank[rank].size();
  }
}

template <typename Write>
void DistributedRun::exchangeWith(Part part, const RobotsByRank& known, const Write& write) {
  if (!near_) {
    out_.clear();
    write(known[0], out_);
    finished(part);
    allGather();
  } else {
    for (std::size_t rank = 0; rank < to_.size(); ++rank) {
      to_[rank].clear();
      if (rank != own_) write(known[rank], to_[rank]);
    }
    finished(part);
    exchange();
  }
  finished(waiting);
}

void DistributedRun::exchangeOrders(const std::exception_ptr& failure) {
  const RobotRange home = shares_.home[own_];
  orders_.begin(run_->environment().phases().orders(), home);
  std::exception_ptr own = own_failure_ ? own_failure_ : failure;
  if (!own) own = failureOf([&] { run_->decide(); });
  finished(controllers);
  const StepOrders orders = run_->environment().phases().orders();
  orders_.end(orders, near_ ? std::span<const std::uint32_t>() : std::span<const std::uint32_t>(orders_of_[0]));
  // For all ranks. A rank with an error sends only that, behind a byte.
  out_.clear();
  if (own) {
    out_ = '\1' + errorBytes(own);
  } else if (!orders_.forAll().empty()) {
    (out_ = '\0') += orders_.forAll();
  }
  for (std::size_t rank = 0; near_ && rank < to_.size(); ++rank) {
    to_[rank].clear();
    if (rank != own_ && !own) orders_.writeCommands(orders, orders_of_[rank], to_[rank]);
  }
  finished(commands);
  if (near_) {
    exchangeAndGather();
  } else {
    allGather();
  }
  finished(waiting);
  throwFirstSent(own);
  for (std::size_t rank = 0; rank < all_.size(); ++rank) {
    if (rank == own_) continue;
    if (near_) readCommands(from_[rank], shares_.home[rank], orders);
    if (!all_[rank].empty()) readOrders(std::string_view(all_[rank]).substr(1), shares_.home[rank], orders);
  }
  finished(commands);
}

void DistributedRun::throwFirstSent(const std::exception_ptr& own) {
  std::vector<std::string_view> errors;
  for (const auto& bytes : all_)
    errors.push_back(!bytes.empty() && bytes[0] ? std::string_view(bytes).substr(1) : std::string_view());
  const std::string error = errorBytes(own);
  errors[own_] = error;
  throwFirstError(group_, errors, own);
}

void DistributedRun::exchangePaths() {
  const PhaseResults results = run_->environment().phases().results();
  exchangeWith(clips, motion_of_,
               [&](std::span<const std::uint32_t> known, std::string& out) { writePaths(results, known, out); });
  for (std::size_t rank = 0; rank < all_.size(); ++rank) {
    if (rank != own_) readPaths(all_[rank], shares_.work[rank], results);
  }
  finished(clips);
}

void DistributedRun::exchangeStays(bool is_end_requested) {
  const PhaseResults results = run_->environment().phases().results();
  is_end_requested_ |= is_end_requested;
  exchangeWith(judgements, motion_of_, [&](std::span<const std::uint32_t> known, std::string& out) {
    out.push_back(is_end_requested ? 1 : 0);
    writeStays(results, known, out);
    if (out.size() == 1 && !is_end_requested) out.clear();
  });
  for (std::size_t rank = 0; rank < all_.size(); ++rank) {
    if (rank == own_ || all_[rank].empty()) continue;
    if (all_[rank][0]) is_end_requested_ = true;
    readStays(std::string_view(all_[rank]).substr(1), shares_.work[rank], results);
  }
  finished(judgements);
}

void DistributedRun::exchangeReadings(const std::vector<RobotRange>& from, const std::vector<RobotRange>& to) {
  const PhaseResults results = run_->environment().phases().results();
  // To all ranks, so that all throw in this step; and behind a byte, as in exchangeOrders().
  const std::string error = errorBytes(own_failure_);
  for (std::size_t rank = 0; rank < to.size(); ++rank) {
    to_[rank].clear();
    const RobotRange sent = intersection(from[own_], to[rank]);
    if (rank == own_ || (sent.empty() && !own_failure_)) continue;
    to_[rank].push_back(own_failure_ ? 1 : 0);
    if (own_failure_) {
      to_[rank] += error;
    } else {
      writeReadings(results, sent, to_[rank]);
    }
  }
  finished(rest);
  exchange();
  finished(waiting);
  throwFirstSent(own_failure_);
  for (std::size_t rank = 0; rank < from.size(); ++rank) {
    if (rank == own_ || all_[rank].empty()) continue;
    readReadings(std::string_view(all_[rank]).substr(1), intersection(from[rank], to[own_]), results);
  }
  finished(rest);
}

void DistributedRun::observe() {
  if (!has_observers_) return;
  Environment& environment = run_->environment();
  StateWriter decided;
  decided.addNumber(std::uint8_t{run_->isOver()});
  for (const auto& applied : environment.state().interventions) {
    if (applied.step > environment.time().step) writeIntervention(applied.intervention, decided);
  }
  group_.broadcast(decided.bytes);
  readRankBytes(decided.bytes, "decisions of observers", [&](StateReader& in) {
    is_over_ = in.takeFlag();
    while (!in.isAtEnd()) {
      const Intervention intervention = readIntervention(in);
      if (own_ > 0) environment.applyAgain(intervention);
    }
  });
  followAdditions();
  finished(waiting);
}

void DistributedRun::balance() {
  StateWriter own;
  own.addNumber(busy_.work_s);
  own.addNumber(busy_.other_s);
  busy_ = {};
  out_ = own.bytes;
  allGather();
  finished(waiting);
  std::vector<BusyTime> busy;
  for (const auto& bytes : all_) {
    readRankBytes(bytes, "times", [&](StateReader& in) {
      const auto work_s = in.takeNumber<double>();
      busy.push_back({work_s, in.takeNumber<double>()});
    });
  }
  const std::vector<RobotRange> before = shares_.work;
  const std::vector<RobotRange> after = balancedWork(before, busy);
  if (after == before) return;
  std::vector<RobotRange> kept_before;
  for (std::size_t rank = 0; rank < shares_.ranks(); ++rank) kept_before.push_back(shares_.kept(rank));
  setWork(after);
  const RobotRange kept = shares_.kept(own_);
  // Both the readings to be sent and those to be received, until they are.
  Environment& environment = run_->environment();
  environment.phases().keepReadings(hull(kept, before[own_]));
  if (overlapOtherRanks(before, after)) exchangeReadings(before, after);
  environment.phases().keepReadings(kept);
  if (!near_) return;
  exchangeMovedShares(before, kept_before);
  findKnownRobots();
  limitToKnownRobots();
}

void DistributedRun::finish(const std::exception_ptr& failure) {
  agree(group_, [&] {
    if (own_failure_) std::rethrow_exception(own_failure_);
    if (failure) std::rethrow_exception(failure);
  });
  if (near_) gatherMotion();
  RunDigest* const digest = run_->environment().phases().results().digest;
  out_.assign(1, run_->hasDrawnRandomNumbers() ? 1 : 0);
  if (digest) digest->save(shares_.digested[own_], out_);
  group_.gather(out_, all_);
  if (own_ > 0) return;
  bool has_drawn = false;
  for (std::size_t rank = 0; rank < all_.size(); ++rank) {
    has_drawn |= all_[rank][0] != 0;
    if (rank == 0 || !digest) continue;
    if (!digest->load(shares_.digested[rank], std::string_view(all_[rank]).substr(1)))
      throw std::runtime_error("rank " + std::to_string(rank) + " has sent an invalid digest");
  }
  run_->setDrawnElsewhere(has_drawn);
}

std::vector<DistributedRun::Measured> DistributedRun::measured() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  measured_.memory_max_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  static_assert(std::is_trivially_copyable_v<Measured>);
  out_.assign(reinterpret_cast<const char*>(&measured_), sizeof measured_);
  group_.gather(out_, all_);
  std::vector<Measured> all;
  for (std::size_t rank = 0; own_ == 0 && rank < all_.size(); ++rank) {
    if (all_[rank].size() != sizeof(Measured)) throw std::runtime_error("a rank runs another version of RoboSim");
    std::memcpy(&all.emplace_back(), all_[rank].data(), sizeof(Measured));
  }
  return all;
}

void DistributedRun::finished(Part part) {
  const double now_s = secondsNow();
  const double time_s = now_s - std::exchange(last_s_, now_s);
  const double processor_s = processorSeconds();
  measured_.time_s[part] += time_s;
  measured_.processor_s[part] += processor_s - std::exchange(last_processor_s_, processor_s);
  if (part == waiting) return;
  const bool is_work = part == clips || part == judgements || part == sensors;
  (is_work ? busy_.work_s : busy_.other_s) += time_s;
}

}  // namespace robosim
