#pragma once
#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributed/near_robots.h"
#include "distributed/rank_shares.h"
#include "distributed/rank_wire.h"
#include "distributed/ranks/rank_group.h"
#include "run/local_run.h"

namespace robosim {

/// Of which robots each rank receives commands and motion.
enum class RankExchange {
  automatic,  ///< of near ones, if that is possible and spares most of the others
  near,       ///< of those near its own, if possible
  all
};

/// Settings of a run on several ranks; the same on all. They do not affect the run.
struct DistributionOptions {
  bool first_needs_readings = false;  ///< whether rank 0 needs the readings of all robots after each step
  std::uint64_t balance_steps = 50;   ///< steps after which moves and sensors are divided again; 0: never
  bool first_needs_poses = false;     ///< whether rank 0 needs the poses of all robots after each step
  RankExchange exchange = RankExchange::automatic;
};

/// One run on several ranks. Each rank runs the controllers, has the readings, and computes moves and sensors of its
/// own robots (RankShares). It knows these and the robots near them (NearRobots), or all, whose state it computes
/// itself from the commands of their controllers. In each step the ranks exchange commands and messages, clipped paths,
/// robots that stay, and readings that another rank needs. The run is the same, bit for bit, as in one process.
class DistributedRun {
 public:
  /// A collective operation. @param world the same on all ranks @param options observers are only used on rank 0
  /// @throws as LocalRun, on all ranks if on one; ConfigError when the worlds differ
  DistributedRun(RankGroup& group, LoadedWorld world, RunOptions options, const DistributionOptions& distribution);

  /// This rank's part of the run. Before finish(), and on other ranks than 0, the state of robots that are not known
  /// is invalid, except their activity.
  LocalRun& run() { return *run_; }
  const LocalRun& run() const { return *run_; }

  /// Runs the controllers and takes one time step; a collective operation.
  /// @param is_end_requested whether this rank wants the run to end after the step, as after an interrupt
  /// @param failure of this rank since the last step; null for none
  /// @param record of LocalRun::step(); does not throw
  /// @throws the error of the first rank with one, on all ranks: a failure, an exception of a controller, a sensor or
  /// an observer. That of a sensor is thrown in the same step if ranks need readings of others, as rank 0 does to
  /// record them; otherwise by the next call of this function or of finish().
  void step(bool is_end_requested, const std::exception_ptr& failure, const std::function<void()>& record = {});
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
    std::uint64_t bytes_sent = 0;              ///< to all ranks at once: counted once
    std::uint64_t bytes_received = 0;          ///< from other ranks
    std::uint64_t robots_moved = 0;            ///< sum over steps: those that the rank knows
    std::uint64_t steps = 0;
    std::uint64_t memory_max_bytes = 0;  ///< of this process
  };
  /// At rank 0, what each rank has measured; elsewhere empty. A collective operation.
  std::vector<Measured> measured();
  const RankShares& shares() const { return shares_; }
  /// Of which robots the ranks receive commands and motion, and why, for a log.
  const std::string& exchangeText() const { return exchange_text_; }

 private:
  using RobotsByRank = std::vector<std::vector<std::uint32_t>>;

  /// Gives the last rank the robots that an intervention has added. Every rank knows all robots then.
  void followAdditions();
  /// Changes RankShares::work.
  void setWork(const std::vector<RobotRange>& work);
  /// Sends to each rank what `write` appends for the robots that it knows, of those of this rank; all_ is what the
  /// others have sent. @param part in which write() takes time
  template <typename Write>
  void exchangeWith(Part part, const RobotsByRank& known, const Write& write);

  /// @name Known robots (distributed_run_known.cpp)
  ///@{
  void chooseExchange();
  /// Of the robots of other ranks, the share that a rank knows on average after findKnownRobots(); without rank 0, if
  /// that needs all in any case.
  double gatherKnownShare();
  /// Exchanges the areas of ranks, and the motion of the robots in them.
  void findKnownRobots();
  void limitToKnownRobots();
  /// Reads all_: motion of robots of the other ranks. @param of_rank ranges of robots, in ascending order
  /// @return the robots that are in all_, in ascending order
  std::vector<std::uint32_t> readMotionOfOthers(const std::vector<RobotRange>& of_rank);
  /// Sends motion to the ranks that newly keep robots. @param before RankShares::work and kept() until now, by rank
  void exchangeMovedShares(const std::vector<RobotRange>& before, const std::vector<RobotRange>& kept_before);
  /// Sends the poses that the referee needs to all ranks.
  void exchangeWinCandidates();
  /// Gives rank 0 the motion of all robots.
  void gatherMotion();
  bool firstNeedsAll() const { return distribution_.first_needs_readings || distribution_.first_needs_poses; }
  ///@}
  void exchangeOrders(const std::exception_ptr& failure);
  /// Throws the first error in all_, where that of a rank follows a byte 1. @param own of this rank; null: none
  void throwFirstSent(const std::exception_ptr& own);
  void exchangePaths();
  void exchangeStays(bool is_end_requested);
  /// Sends readings from the ranks that have those of `from` to those that need those of `to`.
  void exchangeReadings(const std::vector<RobotRange>& from, const std::vector<RobotRange>& to);
  /// Sends to the other ranks what the observers of rank 0 have decided: the end of the run, and interventions.
  void observe();
  void balance();
  /// Sends out_ to all ranks; all_ is then what all have sent.
  void allGather();
  /// Sends to_ to the ranks; all_ is then what they have sent to this one.
  void exchange();
  /// Both: from_ is then what the ranks have sent to this one, and all_ what each has sent to all.
  void exchangeAndGather();
  void countReceived(const std::vector<std::string>& by_rank);
  /// Adds the time since the last call to a part.
  void finished(Part part);

  RankGroup& group_;
  RankShares shares_;
  DistributionOptions distribution_;
  std::size_t own_;  ///< rank
  bool has_observers_;
  bool has_supervisors_;            ///< observers that may change the run
  std::vector<RobotRange> needed_;  ///< by rank: RankShares::needed()
  bool sends_readings_ = false;     ///< whether ranks need readings that others compute
  std::unique_ptr<LocalRun> run_;
  std::unique_ptr<NearRobots> near_;    ///< null: every rank knows all robots
  std::uint64_t near_until_step_ = 0;   ///< when the areas must be renewed
  RobotsByRank orders_of_, motion_of_;  ///< robots whose controllers run here, and that move here, by the ranks that
                                        ///< know them; one list when every rank knows all
  std::vector<std::uint32_t> known_;    ///< by this rank; empty when every rank knows all
  std::string exchange_text_;
  OrdersWriter orders_;
  std::exception_ptr own_failure_;  ///< of this rank in the last step, not known to the others: of a sensor, or of the
                                    ///< controller of an added robot
  bool is_end_requested_ = false;
  bool is_over_ = false;
  std::string out_;                      ///< bytes of this rank in an exchange
  std::vector<std::string> to_;          ///< the same, by the rank to which they are sent
  std::vector<std::string> all_, from_;  ///< bytes of all ranks
  Measured measured_;
  BusyTime busy_;  ///< since the last balance()
  double last_s_ = 0, last_processor_s_ = 0;
};

}  // namespace robosim
