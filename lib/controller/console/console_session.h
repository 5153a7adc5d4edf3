#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "console/best_of_day.h"
#include "console/console_feed.h"
#include "console/game_json.h"
#include "console/map_view.h"
#include "console/order_limiter.h"
#include "console/page_authorization.h"
#include "console/page_json.h"
#include "console/page_outbox.h"
#include "console/rounds.h"
#include "console/run_view.h"
#include "console/team_events.h"
#include "net/access.h"
#include "remote/orders.h"
#include "web/message.h"

namespace robosim {

/// @name Outputs of ConsoleSession, to be performed in sequence
///@{
/// A message may be available for a page: ConsoleSession::nextMessage().
struct WakePage {
  PageId page;
};
/// Disconnects a page after its queued messages have been sent.
struct DisconnectPage {
  PageId page;
  std::string why;
};

/// Sends an order to the primary robot.
struct SendOrder {
  v1::ControlRequest order;
};
/// Claims the primary robot for a driver. The robot stands until it is steered.
struct SetDriver {
  std::string name;
};
/// Makes another robot the primary; the result is reported by the next ConsoleSession::update().
struct SwitchPrimary {
  std::string robot;
};

/// Loads the environment's world again, after its run has ended; for rounds of visitors also before.
struct RestartRun {
  bool paused = false;  ///< until ResumeRun
};
struct ResumeRun {};
/// Stores the results of the day, as BestOfDay::text().
struct SaveResults {
  std::string text;
};
/// Starts or stops the recording of the environment's run.
struct RecordRun {
  bool on;
};

/// Starts or stops the map, which is fetched only while a page shows it.
struct WatchMap {
  bool watched;
};

/// Writes a line to the log. Lines with a kind can be caused by any client, and are rate-limited per kind.
struct WriteLog {
  std::string_view kind;  ///< empty: not limited. A constant
  std::string line;
};
/// Writes a line to the audit log (AuditLog).
struct WriteAudit {
  Identity client;
  std::string peer, action;
};

using ConsoleAction = std::variant<WakePage, DisconnectPage, SendOrder, SetDriver, SwitchPrimary, RestartRun, ResumeRun,
                                   SaveResults, RecordRun, WatchMap, WriteLog, WriteAudit>;
using ConsoleActions = std::vector<ConsoleAction>;
///@}

/// State machine of the console: admits pages, holds the control lock, converts the pages' messages to orders for the
/// primary robot, and selects the next message for each page. Events are function calls; outputs are the returned
/// actions and nextMessage(). It has no socket and no thread, and its deadlines depend only on the time passed as a
/// parameter, which must not decrease; the expiry of tokens depends on the clock of its Access (Access::Options::now).
///
/// Every message of a page is authorised (page_authorization.h) before it is handled. Messages are untrusted: no
/// function throws because of them, and a page that sends an invalid one is disconnected. What waits for a page is
/// bounded (PageOutbox). Pages whose hello has not been received: at most kMaxSilent, beyond which the oldest is
/// disconnected, and each for at most kHelloWithin.
///
/// After actions that change the team (SetDriver, SwitchPrimary, the order of a mode) update() must follow before the
/// next message. Orders that move a robot are ignored while a switch is pending.
class ConsoleSession {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kMaxSilent = 128;
  static constexpr std::chrono::seconds kHelloWithin{10};

  /// State of everything outside.
  struct Inputs {
    std::vector<TeamRobot> robots;       ///< in the order of the queue: the primary first; not empty
    std::shared_ptr<const MapView> map;  ///< the newest; null without a map, or while it is not watched
    std::uint64_t access_version = 0;    ///< of Access::refresh()
    RunView run{};
    std::string today{};  ///< for results of the day, such as "2026-11-28"
  };

  /// @param access rights by token
  /// @param rounds of visitors, who then receive the control lock in turn (Rounds); nullopt: pages take it
  /// @param best results of the day so far
  explicit ConsoleSession(Access access, std::optional<Rounds::Options> rounds = std::nullopt, BestOfDay best = {})
      : access_(std::move(access)), best_(std::move(best)) {
    if (rounds) rounds_.emplace(*std::move(rounds));
  }

  /// @param id greater than all previous ones
  /// @param peer address
  ConsoleActions pageOpened(PageId id, const std::string& peer, Time now);
  ConsoleActions pageClosed(PageId id);
  ConsoleActions pageMessage(PageId id, std::string_view text, Time now);
  /// A page has sent what is not a text message within the limits: it is disconnected.
  ConsoleActions pageInvalid(PageId id, const std::string& why);
  /// Takes the state of team, map and tokens, and checks deadlines. To be called first, at least 20 times per second,
  /// and when there is news.
  ConsoleActions update(const Inputs& inputs, Time now);

  /// The next message for a page; null for none. To be called after WakePage and after each message sent, when the
  /// connection accepts another.
  WebMessagePtr nextMessage(PageId id, Time now);

  /// The page that holds the control lock; 0 for none.
  PageId lockHolder() const { return lock_.holder; }
  /// The outbox of an open page; null for others.
  const PageOutbox* outboxOf(PageId id) const;

 private:
  struct Page {
    PageId id = 0;
    std::string peer, name;
    Identity client;
    Time opened;
    bool is_admitted = false;  ///< its hello was accepted
    bool is_leaving = false;   ///< DisconnectPage was returned: its messages are ignored
    PageOutbox outbox;
  };
  struct PendingSwitch {
    PageId page;
    std::string robot;
  };

  /// @name Messages of pages (console_session_messages.cpp)
  ///@{
  void handle(Page& page, const PageMessage& message, Time now);
  void handleHello(Page& page, const PageMessage& message);
  void acknowledge(Page& page, std::uint64_t number, Time now);
  void subscribeMap(Page& page, bool on);
  void take(Page& page);
  void giveOrder(Page& page, const PageMessage& message, OrderType type, Time now);
  v1::ControlRequest orderOf(const Page& page, const PageMessage& message, OrderType type) const;
  void switchPrimary(Page& page, const std::string& robot);
  void playAgain(Page& page);
  void record(Page& page, bool on);
  void join(Page& page, const PageMessage& message, Time now);
  void deny(Page& page, const PageMessage& message, const std::string& why);
  ///@}

  /// @name Pages and the control lock
  ///@{
  Page* find(PageId id);
  PageState stateOf(const Page& page) const;
  void reject(Page& page, const std::string& why);
  void disconnect(Page& page, const std::string& why);
  void disconnectInvalid(Page& page, const std::string& why);
  void disconnectOldestSilent();
  void release(Page& page, const std::string& why);
  void reply(Page& page, const std::string& json);
  void noteToAll(const std::string& json);
  /// Gives the control lock to a page. The robot stands for the new driver, even if the driver is the same.
  void giveControl(Page& page);
  ///@}

  /// @name Rounds of visitors, and results (console_session_rounds.cpp)
  ///@{
  void leaveRounds(Page& page);
  void skipRound(Page& page);
  void revokeEndedRound();
  void updateRounds(Time now);
  Rounds::Inputs roundInputs() const;
  void explore(Time now);
  void takeWin();
  /// Name of a page without one.
  static std::string pageName(PageId page) { return "Page " + std::to_string(page); }
  void addResult(const RoundResult& result);
  void publishGame(Time now);
  ///@}

  /// @name Steps of update()
  ///@{
  void checkAccess(std::uint64_t version);
  void checkDeadlines(Time now);
  void finishSwitch();
  void reportEvents();
  void reportAnswers();
  bool takeRobots(const std::vector<TeamRobot>& robots);
  void takeRun(const RunView& run);
  bool takeMap(const std::shared_ptr<const MapView>& map);
  void wakeAdmittedPages();
  void publishTeam();
  void publishVitals(Time now);
  void watchMap();
  void wakePages(bool is_news, Time now);
  ///@}

  const std::string& primary() const;
  template <typename Action>
  void act(Action&& action) {
    actions_.emplace_back(std::forward<Action>(action));
  }
  void audit(const Page& page, const std::string& action);
  ConsoleActions takeActions();

  Access access_;
  std::uint64_t access_version_ = 0;
  std::map<PageId, Page> pages_;
  ControlLock lock_;
  std::vector<TeamRobot> robots_;  ///< at the last update(); the primary first
  TeamEvents events_;
  std::array<std::shared_ptr<const RobotAnswer>, kReadings> answers_;  ///< of the primary, already sent
  OrderLimiter orders_;
  std::optional<PendingSwitch> pending_switch_;
  bool is_map_watched_ = false;
  RunView run_;
  bool was_over_ = false;  ///< the run, at the last update()
  std::optional<Rounds> rounds_;
  BestOfDay best_;
  std::string today_;
  std::optional<GameResult> game_result_;
  std::string winner_;          ///< of the run, at the last update()
  bool is_win_listed_ = false;  ///< takeWin() has added it
  bool may_explore_ = true;     ///< since a page has stopped the robot, a visitor has joined or driven
  Time explored_{};             ///< of the last attempt to let the robot explore
  struct GameVersion {
    std::uint64_t rounds = 0, result = 0;
    int left_s = 0;
    std::string day;
    bool operator==(const GameVersion&) const = default;
  };
  std::optional<GameVersion> game_version_;  ///< published
  ConsoleFeed feed_;
  Time vitals_published_{};
  Time now_{};              ///< of the newest event
  ConsoleActions actions_;  ///< of the current event
};

}  // namespace robosim
