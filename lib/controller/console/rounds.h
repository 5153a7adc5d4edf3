#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remote/robot_news.h"
#include "web/message.h"

namespace robosim {

/// A visitor of an open house: a page whose user waits for a round, or drives.
struct Visitor {
  PageId page = 0;
  std::string name;
  std::string team{};  ///< one of Rounds::Options::teams; empty for none
};

/// How a round has ended.
struct RoundResult {
  Visitor visitor;
  bool has_won = false;
  double time_s = 0;                   ///< simulation time from the start of the round
  std::optional<double> distance_m{};  ///< driven in the round; nullopt without odometry
};

/// State machine of an open house: a queue of visitors, who drive the primary robot one after the other, each for a
/// round. A round begins in a new run of the world, which is paused until the visitor's robot is in it, so that all
/// visitors start at the same place. It ends when the run does (a win), after its length, or when its visitor leaves. A
/// visitor who waits is called, and must confirm within kCallWithin; one who finds an empty queue begins at once. While
/// no visitor waits or drives, the robot explores by itself.
///
/// Neither sockets nor clocks: time is a parameter, and what is to be done is returned. The control lock, the orders to
/// the robot and the restart of the run are ConsoleSession's.
class Rounds {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::seconds kCallWithin{20};   ///< to confirm
  static constexpr std::chrono::seconds kLoadWithin{60};   ///< for the world, after which the round is cancelled
  static constexpr std::chrono::seconds kStartWithin{20};  ///< from then, after which the round is cancelled
  static constexpr std::chrono::seconds kResumeAfter{5};   ///< also if the robot has not joined the new run
  static constexpr std::chrono::seconds kResultFor{12};    ///< display of a result
  static constexpr std::chrono::seconds kExploreAfter{5};  ///< without a visitor
  static constexpr std::size_t kMaxWaiting = 100;

  struct Options {
    std::chrono::seconds length{180};  ///< of a round, wall-clock time
    std::vector<std::string> teams{};  ///< that visitors may select; empty: no teams
  };

  enum class Phase : std::uint8_t {
    idle,      ///< no visitor waits or drives
    called,    ///< the next visitor must confirm
    starting,  ///< a new run is being started
    driving,
    result,  ///< of the last round
  };

  /// State of the primary robot and of the run.
  struct Inputs {
    bool may_restart = false;    ///< the run can be replaced by a new one
    bool is_restarting = false;  ///< which is being done
    bool is_run_over = false;
    bool is_up = false;  ///< the robot is connected, and its run not over
    bool has_won = false;
    std::shared_ptr<const RobotUpdate> update{};  ///< the robot's newest; null as long as there is none
  };

  /// What is to be done now.
  struct Actions {
    std::optional<Visitor> begins{};    ///< receives the control lock
    bool restarts = false;              ///< the run is to be replaced by a paused one
    bool resumes = false;               ///< which is to be started
    std::optional<RoundResult> ends{};  ///< its page loses the control lock
    bool explores = false;              ///< the robot is to explore by itself
    std::optional<Visitor> failed{};    ///< its round could not be started, and its page loses the control lock
  };

  explicit Rounds(Options options) : options_(std::move(options)) {}

  /// @name Events
  ///@{
  /// Adds a visitor to the queue, or changes the name and the team of one who waits.
  /// @return false if the queue is full
  bool join(const Visitor& visitor, Time now);
  /// The visitor who was called confirms. No effect for others.
  void start(PageId page, Time now);
  /// A visitor leaves the queue, or ends the round without a result.
  void leave(PageId page, Time now);
  /// Ends the round, or calls the next visitor.
  void skip(Time now);
  Actions update(const Inputs& inputs, Time now);
  ///@}

  const Options& options() const { return options_; }
  Phase phase() const { return phase_; }
  /// The visitor who was called or drives; nullopt in other phases.
  const std::optional<Visitor>& visitor() const { return visitor_; }
  const std::deque<Visitor>& queue() const { return queue_; }
  /// Time until the phase ends [s], rounded up; 0 for phases without an end.
  int secondsLeft(Time now) const;
  /// Changes with the phase, the visitor and the queue.
  std::uint64_t revision() const { return revision_; }

 private:
  void enter(Phase phase, Time now);
  void callNext(Time now);
  void begin(Time now);
  void updateStart(const Inputs& inputs, Time now, Actions& actions);
  void cancelStart(Time now, Actions& actions);
  void updateRound(const Inputs& inputs, Time now, Actions& actions);

  Options options_;
  Phase phase_ = Phase::idle;
  std::optional<Time> since_;  ///< begin of the phase; nullopt before the first event
  std::deque<Visitor> queue_;
  std::optional<Visitor> visitor_;
  bool is_skipped_ = false;
  std::uint64_t revision_ = 1;

  /// @name Start of a round
  ///@{
  bool has_begun_ = false;   ///< the visitor has the control lock
  bool is_replaced_ = true;  ///< the robot has left the previous run
  bool is_loading_ = false;  ///< the world of the new run
  bool is_paused_ = false;   ///< the new run
  std::shared_ptr<const RobotUpdate> before_;
  ///@}
  std::shared_ptr<const RobotUpdate> first_;  ///< of the round
};

const char* nameOf(Rounds::Phase phase);

}  // namespace robosim
