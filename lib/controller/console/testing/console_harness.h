#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "console/console_session.h"
#include "control/testing/fake_hardware.h"
#include "net/robot_wire.h"

namespace robosim {

/// A ConsoleSession with a team and pages that consist of plain values. The harness passes events to the session,
/// performs the returned actions on the team, and checks after each event what must hold in every state:
///
/// - An order that moves a robot, or enables its controller, is caused by a page that holds the control lock and whose
///   token permits the robot; only such a robot becomes the primary.
/// - After a stop, a switch or a new driver no robot moves without a new message of the holder. An authorised stop
///   reaches the robot at once.
/// - The outbox of every page is within its bounds.
/// - Messages of pages that are being disconnected have no effect.
///
/// A violation throws std::logic_error. Time is counted by the harness, for the session and for the expiry of tokens.
class ConsoleHarness {
 public:
  using Type = PageMessage::Type;

  /// A page as its user sees it.
  struct Page {
    std::optional<std::string> token;  ///< of its last hello with one
    std::vector<std::string> texts;    ///< messages received by read()
    std::uint64_t updates = 0, pictures = 0, acknowledged = 0;
    bool is_leaving = false;
    std::string why;  ///< of its disconnection

    bool has(std::string_view text) const { return countOf(text) > 0; }
    std::size_t countOf(std::string_view text) const {
      return static_cast<std::size_t>(std::count_if(
          texts.begin(), texts.end(), [&](const auto& message) { return message.find(text) != std::string::npos; }));
    }
  };
  struct Order {
    std::string robot;
    v1::ControlRequest order;
  };

  /// @param tokens token file; empty: every page has every right
  /// @param rounds of visitors; nullopt for none
  explicit ConsoleHarness(const std::string& tokens = "",
                          const std::vector<std::string>& robots = {"Ann", "Bob", "Cid"},
                          const std::optional<Rounds::Options>& rounds = std::nullopt)
      : access(tokens.empty() ? Access() : Access::parse(tokens, "tokens", accessOptions())),
        session(access, rounds),
        has_rounds(rounds.has_value()),
        reference_(tokens.empty() ? Access() : Access::parse(tokens, "tokens", accessOptions())) {
    const FakeHardware hardware;
    for (const auto& name : robots) {
      auto info = std::make_shared<RobotInfo>(hardware.info());
      info->name = name;
      row.push_back({name, "127.0.0.1:9", {}});
      row.back().news.info = std::move(info);
      row.back().news.is_up = true;
      row.back().news.period_s = 0.1;
    }
    update();
  }
  ConsoleHarness(const ConsoleHarness&) = delete;
  ConsoleHarness& operator=(const ConsoleHarness&) = delete;

  /// @name Events
  ///@{
  PageId open(const std::string& peer = "127.0.0.1") {
    pages[++last_page_];
    perform(session.pageOpened(last_page_, peer, now));
    return last_page_;
  }
  /// Opens a page and sends its hello.
  PageId join(const std::string& token = "", const std::string& name = "Page") {
    const PageId id = open();
    hello(id, token, name);
    return id;
  }
  void hello(PageId id, const std::string& token = "", const std::string& name = "Page") {
    send(id, R"({"type":"hello","protocol":1,"name":")" + name + R"(","token":")" + token + "\"}");
  }
  void send(PageId id, const std::string& text) {
    Page& page = pages.at(id);
    const bool was_leaving = page.is_leaving;
    const bool must_stop = !was_leaving && expect(id, page, text);
    const auto actions = session.pageMessage(id, text, now);
    require(!was_leaving || actions.empty(), "a page that is being disconnected causes nothing");
    const std::size_t stops = stops_;
    perform(actions);
    require(!must_stop || stops_ > stops, "an authorised stop reaches the robot at once");
  }
  /// The web server receives a frame that is not a text message.
  void invalidFrame(PageId id, const std::string& why) { perform(session.pageInvalid(id, why)); }
  void close(PageId id) {
    const auto actions = session.pageClosed(id);
    pages.erase(id);
    perform(actions);
    require(session.lockHolder() != id, "a closed page does not hold the control lock");
  }
  /// Time passes, then the session is updated.
  void tick(std::chrono::milliseconds time = std::chrono::milliseconds(0)) {
    now += time;
    update();
  }
  /// A step of the primary robot, with a new picture if `jpeg` is not empty.
  void step(const std::string& jpeg = "") {
    RobotNews& news = row.front().news;
    auto update = std::make_shared<RobotUpdate>();
    update->readings = blankReadings(*news.info->sensors);
    update->readings.time = {++steps_, news.period_s};
    update->state = news.state;
    news.update = std::move(update);
    if (!jpeg.empty()) news.picture = std::make_shared<const RobotPicture>(RobotPicture{steps_, jpeg});
    this->update();
  }
  void update() { perform(session.update({row, is_map_watched ? map : nullptr, access.refresh(), run, today}, now)); }
  ///@}

  /// Sends up to `most` waiting messages to a page. @return their number
  std::size_t read(PageId id, std::size_t most = SIZE_MAX) {
    Page& page = pages.at(id);
    std::size_t count = 0;
    for (; count < most; ++count) {
      const auto message = session.nextMessage(id, now);
      if (!message) break;
      if (message->isBinary()) {
        ++page.updates;
        if (message->bytes().find("picture_step") != std::string_view::npos) ++page.pictures;
      } else {
        page.texts.emplace_back(message->bytes());
      }
    }
    require(page.is_leaving || page.updates <= page.acknowledged + PageOutbox::kMaxUnacknowledged,
            "at most three updates are not acknowledged");
    return count;
  }
  void acknowledge(PageId id) { send(id, R"({"type":"ack","number":)" + std::to_string(pages.at(id).updates) + "}"); }

  /// The orders since the last call, without requests for readings.
  std::vector<Order> takeOrders() { return std::exchange(orders, {}); }
  const std::string& primary() const { return row.front().name; }
  Page& page(PageId id) { return pages.at(id); }
  bool hasLogged(std::string_view text) const {
    return std::any_of(log.begin(), log.end(), [&](const auto& line) { return line.find(text) != std::string::npos; });
  }

  static bool moves(const v1::ControlRequest& order) { return order.has_drive() || order.has_steer(); }

  std::chrono::steady_clock::time_point now{std::chrono::hours(1)};
  Access access;
  ConsoleSession session;
  bool has_rounds;
  std::vector<TeamRobot> row;  ///< the primary first
  std::shared_ptr<const MapView> map;
  bool is_map_watched = false;
  RunView run;
  std::string today = "2027-01-01";
  std::map<PageId, Page> pages;
  std::vector<Order> orders;
  std::vector<std::string> log;
  std::string saved;  ///< the newest results of the day
  std::size_t motions = 0, switches = 0, disconnections = 0, restarts = 0, resumptions = 0;  ///< in all
  std::vector<bool> recordings;  ///< requests to start and stop the recording

 private:
  Access::Options accessOptions() {
    Access::Options options;
    options.now = [this] {
      const auto elapsed = std::chrono::duration_cast<std::chrono::system_clock::duration>(now.time_since_epoch());
      return std::chrono::system_clock::time_point(std::chrono::sys_days(std::chrono::year(2027) / 1 / 1)) + elapsed;
    };
    return options;
  }
  static void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string("violated: ") + what);
  }

  /// Whether the holder of the control lock may drive a robot.
  bool holderMayDrive(const std::string& robot) const {
    const auto page = pages.find(session.lockHolder());
    if (page == pages.end()) return false;
    const std::string token = page->second.token.value_or("");  // also the address, for the limit on wrong tokens
    const auto [status, client] = reference_.authenticate(token, token);
    return status.ok() && mayDrive(reference_, client, robot);
  }

  /// Notes what a message entitles to. @return whether it is a stop that must reach the robot
  bool expect(PageId id, Page& page, const std::string& text) {
    try {
      const PageMessage message = PageMessage::parse(text);
      if (message.type == Type(ConsoleRequest::hello) && !message.token.empty()) page.token = message.token;
      if (message.type == Type(ConsoleRequest::ack)) page.acknowledged = std::max(page.acknowledged, message.number);
      if (session.lockHolder() != id) return false;
      const auto* const order = std::get_if<OrderType>(&message.type);
      if (order && moves(makeOrder(*order))) may_move_ = true;
      return order && *order == OrderType::stop && holderMayDrive(primary());
    } catch (const WireError&) {
      return false;
    }
  }

  void perform(const ConsoleActions& actions) {
    bool has_changed = false;
    for (const auto& action : actions) has_changed |= std::visit(*this, action);
    for (const auto& [id, page] : pages) {
      const PageOutbox* outbox = session.outboxOf(id);
      require(outbox && outbox->queued() <= PageOutbox::kMaxQueued, "a bounded number of messages waits for a page");
      require(outbox->unacknowledged() <= PageOutbox::kMaxUnacknowledged, "updates are acknowledged");
    }
    if (has_changed) update();
  }

 public:
  /// @name Actions of the session. @return whether the team has changed
  ///@{
  bool operator()(const WakePage&) { return false; }
  bool operator()(const DisconnectPage& action) {
    Page& page = pages.at(action.page);
    require(!page.is_leaving, "a page is disconnected once");
    ++disconnections;
    page.is_leaving = true;
    page.why = action.why;
    return false;
  }
  bool operator()(const SendOrder& action) {
    const v1::ControlRequest& order = action.order;
    if (order.has_req_reading()) {
      answer(typeOf(order));
      return true;
    }
    if (order.has_set_mode()) {
      const bool explores = has_rounds && session.lockHolder() == 0 && order.set_mode().autonomous();
      require(explores || holderMayDrive(primary()),
              "a robot's controller is enabled by the holder of the control lock, or between rounds of visitors");
      row.front().news.state.set_autonomous(order.set_mode().autonomous());
      return true;
    }
    if (moves(order)) {
      require(holderMayDrive(primary()), "a robot moves only for the holder of the control lock and its token");
      require(may_move_, "no motion after a stop, a switch or a new driver without a new message");
      ++motions;
    }
    if (order.has_stop()) {
      may_move_ = false;
      ++stops_;
    }
    orders.push_back({primary(), order});
    return false;
  }
  bool operator()(const SetDriver& action) {
    require(holderMayDrive(primary()), "a robot's driver holds the control lock and may drive it");
    row.front().news.state.set_driver(action.name);
    row.front().news.state.set_is_yours(true);
    may_move_ = false;
    return true;
  }
  bool operator()(const SwitchPrimary& action) {
    require(holderMayDrive(primary()) && holderMayDrive(action.robot),
            "only a robot that the token permits is primary");
    may_move_ = false;
    const auto target =
        std::find_if(row.begin() + 1, row.end(), [&](const TeamRobot& robot) { return robot.name == action.robot; });
    require(target != row.end(), "a robot of the team becomes primary");
    if (fails_switches) return true;
    ++switches;
    row.front().news.state.set_autonomous(true);
    std::rotate(row.begin(), target, target + 1);
    std::rotate(row.begin() + 1, row.begin() + 2, row.end());  // the old primary moves to the end
    row.front().news.state.set_autonomous(false);
    row.front().news.state.set_is_yours(true);
    return true;
  }
  bool operator()(const RestartRun&) {
    require(run.may_restart || (has_rounds && run.may_replace),
            "a run is started only after the end of the previous one");
    require(!run.is_restarting, "a run is started once");
    if (has_rounds) row.front().news.is_up = false;  // it leaves the run
    ++restarts;
    return false;
  }
  bool operator()(const ResumeRun&) {
    require(has_rounds, "only rounds of visitors load a run that is paused");
    row.front().news.is_up = true;
    ++resumptions;
    return false;
  }
  bool operator()(const SaveResults& action) {
    saved = action.text;
    return false;
  }
  bool operator()(const RecordRun& action) {
    require(run.recording.may_change && !run.recording.is_changing, "a recording is changed only when it can be");
    recordings.push_back(action.on);
    return false;
  }
  bool operator()(const WatchMap& action) {
    is_map_watched = action.watched;
    return false;
  }
  bool operator()(const WriteLog& action) {
    log.push_back(action.line);
    return false;
  }
  bool operator()(const WriteAudit& action) {
    log.push_back(action.client.name() + ": " + action.action);
    return false;
  }
  ///@}

  bool fails_switches = false;  ///< robots become unfit before a switch is performed

 private:
  void answer(OrderType type) {
    auto answer = std::make_shared<RobotAnswer>();
    answer->step = steps_;
    row.front().news.answers[readingIndex(type)] = std::move(answer);
  }

  Access reference_;  ///< with the same tokens, and a limit on wrong tokens of its own
  PageId last_page_ = 0;
  std::uint64_t steps_ = 0;
  std::size_t stops_ = 0;
  bool may_move_ = false;  ///< the holder has commanded motion since the last stop
};

}  // namespace robosim
