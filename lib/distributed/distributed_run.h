#pragma once
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "distributed/rank_shares.h"
#include "distributed/rank_wire.h"
#include "ranks/rank_group.h"
#include "run/local_run.h"

namespace robosim {

/// Settings of a run on several ranks; the same on all. They do not affect the run.
struct DistributionOptions {
  bool first_needs_readings = false;  ///< whether rank 0 needs the readings of all robots after each step
  std::uint64_t balance_steps = 50;   ///< steps after which moves and sensors are divided again; 0: never
};

/// One run on several ranks. Each rank has the state of all robots, and computes it itself from the commands of all
/// controllers; it runs the controllers, has the readings, and computes moves and sensors of its own robots
/// (RankShares). In each step the ranks exchange commands and messages, clipped paths, robots that stay, and readings
/// that another rank needs. The run is the same, bit for bit, as in one process.
class DistributedRun {
 public:
  /// A collective operation. @param world the same on all ranks @param options observers are only used on rank 0
  /// @throws as LocalRun, on all ranks if on one; ConfigError when the worlds differ
  DistributedRun(RankGroup& group, LoadedWorld world, RunOptions options, const DistributionOptions& distribution);

  /// This rank's part of the run.
  LocalRun& run() { return *run_; }
  const LocalRun& run() const { return *run_; }

  /// Runs the controllers and takes one time step; a collective operation.
  /// @param is_end_requested whether this rank wants the run to end after the step, as after an interrupt
  /// @param failure of this rank since the last step; null for none
  /// @throws the error of the first rank with one, on all ranks: a failure, an exception of a controller or an observer
  void step(bool is_end_requested, const std::exception_ptr& failure);
  /// Whether a rank has requested the end.
  bool isEndRequested() const { return is_end_requested_; }
  /// Whether the run has reached an end of its own, also by an observer on rank 0.
  bool isOver() const { return is_over_ || run_->isOver(); }

  /// Completes run() on rank 0: the digest, and what its summary reports; a collective operation.
  /// @param failure of this rank since the last step; null for none
  /// @throws as step()
  void finish(const std::exception_ptr& failure);

  /// Parts of a step, by which time is measured.
  enum Part { controllers, commands, clips, judgements, moves, sensors, rest, waiting };
  static constexpr std::size_t kParts = waiting + 1;
  /// What this rank has measured so far.
  struct Measured {
    std::array<double, kParts> time_s{};       ///< elapsed
    std::array<double, kParts> processor_s{};  ///< of all threads; of a part that waits, the transport's
    std::uint64_t bytes_sent = 0;
    std::uint64_t steps = 0;
    std::uint64_t memory_max_bytes = 0;  ///< of this process
  };
  /// At rank 0, what each rank has measured; elsewhere empty. A collective operation.
  std::vector<Measured> measured();
  const RankShares& shares() const { return shares_; }

 private:
  void exchangeOrders(const std::exception_ptr& failure);
  void exchangePaths();
  void exchangeStays(bool is_end_requested);
  /// Sends readings from the ranks that have those of `from` to those that need those of `to`.
  void exchangeReadings(const std::vector<RobotRange>& from, const std::vector<RobotRange>& to);
  void observe();
  void balance();
  void allGather();
  /// Adds the time since the last call to a part.
  void finished(Part part);

  RankGroup& group_;
  RankShares shares_;
  DistributionOptions distribution_;
  std::size_t own_;  ///< rank
  bool has_observers_;
  std::unique_ptr<LocalRun> run_;
  OrdersWriter orders_;
  bool is_end_requested_ = false;
  bool is_over_ = false;
  std::string out_;               ///< bytes of this rank in an exchange
  std::vector<std::string> all_;  ///< bytes of all ranks
  std::vector<std::string> to_, from_;
  Measured measured_;
  BusyTime busy_;  ///< since the last balance()
  double last_s_ = 0, last_processor_s_ = 0;
};

}  // namespace robosim
