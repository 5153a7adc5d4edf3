#include "console/console_session.h"

#include <algorithm>
#include <utility>

namespace robosim {
namespace {

/// Minimum between two messages with the heat and stall of all robots.
constexpr std::chrono::seconds kVitalsPeriod{1};

bool isSilent(const auto& page) { return !page.is_admitted && !page.is_leaving; }

}  // namespace

ConsoleActions ConsoleSession::pageOpened(PageId id, const std::string& peer, Time now) {
  now_ = now;
  disconnectOldestSilent();
  Page& page = pages_[id];
  page.id = id;
  page.peer = peer;
  page.opened = now;
  return takeActions();
}

ConsoleActions ConsoleSession::pageClosed(PageId id) {
  if (Page* page = find(id)) {
    if (!page->name.empty()) audit(*page, "leave");
    if (rounds_) rounds_->leave(id, now_);
    release(*page, page->name + "'s page has disconnected");
    pages_.erase(id);
    publishTeam();
    watchMap();
  }
  return takeActions();
}

ConsoleActions ConsoleSession::pageMessage(PageId id, std::string_view text, Time now) {
  now_ = now;
  Page* page = find(id);
  if (!page || page->is_leaving) return {};
  try {
    const PageMessage message = PageMessage::parse(text);
    const Authorization authorization = authorize(access_, page->client, stateOf(*page), message);
    switch (authorization.result) {
      case Authorization::Result::permitted:
        handle(*page, message, now);
        break;
      case Authorization::Result::ignored:
        break;
      case Authorization::Result::denied:
        deny(*page, message, authorization.why);
        break;
      case Authorization::Result::protocol_error:
        disconnectInvalid(*page, authorization.why);
        break;
    }
  } catch (const WireError& error) {
    disconnectInvalid(*page, error.what());
  }
  return takeActions();
}

ConsoleActions ConsoleSession::pageInvalid(PageId id, const std::string& why) {
  Page* page = find(id);
  if (page && !page->is_leaving) disconnectInvalid(*page, why);
  return takeActions();
}

ConsoleActions ConsoleSession::update(const Inputs& inputs, Time now) {
  now_ = now;
  bool is_news = takeRobots(inputs.robots);
  checkAccess(inputs.access_version);
  if (auto order = orders_.due(now)) act(SendOrder{*std::move(order)});
  reportEvents();
  reportAnswers();
  publishTeam();
  publishVitals(now);
  takeRun(inputs.run);
  best_.setDay(today_ = inputs.today);
  takeWin();
  updateRounds(now);
  publishGame(now);
  is_news |= takeMap(inputs.map);
  checkDeadlines(now);
  wakePages(is_news, now);
  return takeActions();
}

WebMessagePtr ConsoleSession::nextMessage(PageId id, Time now) {
  Page* page = find(id);
  return page ? page->outbox.next(feed_, page->is_admitted && !page->is_leaving, now) : nullptr;
}

const PageOutbox* ConsoleSession::outboxOf(PageId id) const {
  const auto found = pages_.find(id);
  return found == pages_.end() ? nullptr : &found->second.outbox;
}

ConsoleSession::Page* ConsoleSession::find(PageId id) {
  const auto found = pages_.find(id);
  return found == pages_.end() ? nullptr : &found->second;
}

const std::string& ConsoleSession::primary() const {
  static const std::string none;
  return robots_.empty() ? none : robots_.front().name;
}

PageState ConsoleSession::stateOf(const Page& page) const {
  return {.is_admitted = page.is_admitted,
          .holds_lock = lock_.holder == page.id,
          .primary = primary(),
          .is_primary_known = feed_.primary.info != nullptr,
          .is_switching = pending_switch_.has_value()};
}

/// Disconnects a page whose token is not valid, or no longer. The page requests another from its user.
void ConsoleSession::reject(Page& page, const std::string& why) {
  page.is_admitted = false;
  reply(page, refusedJson(why));
  act(WriteLog{"refused pages", "refused a page at " + page.peer + ": " + why});
  disconnect(page, why);
}

void ConsoleSession::disconnect(Page& page, const std::string& why) {
  if (std::exchange(page.is_leaving, true)) return;
  act(DisconnectPage{page.id, why});
  if (rounds_) rounds_->leave(page.id, now_);
  release(page, page.name + "'s page was disconnected");
  publishTeam();
  watchMap();
}

void ConsoleSession::disconnectInvalid(Page& page, const std::string& why) {
  act(WriteLog{"invalid messages of pages", "disconnected a page at " + page.peer + ": " + why});
  disconnect(page, why);
}

void ConsoleSession::disconnectOldestSilent() {
  const auto is_silent = [](const auto& page) { return isSilent(page.second); };
  if (static_cast<std::size_t>(std::count_if(pages_.begin(), pages_.end(), is_silent)) < kMaxSilent) return;
  const auto oldest = std::find_if(pages_.begin(), pages_.end(), is_silent);  // ids rise
  disconnect(oldest->second, "no hello yet, and too many connections like this; send the hello at once");
}

/// Releases the control lock and stops the robot. No effect for a page that does not hold the lock.
void ConsoleSession::release(Page& page, const std::string& why) {
  if (lock_.holder != page.id) return;
  audit(page, "release " + primary() + ": " + why);
  lock_ = {};
  if (rounds_) rounds_->leave(page.id, now_);
  orders_.clear();
  act(SendOrder{stopOrder(why)});
  publishTeam();
}

void ConsoleSession::giveControl(Page& page) {
  if (lock_.holder != page.id) audit(page, "take " + primary());
  lock_.holder = page.id;
  lock_.name = page.name;
  orders_.clear();
  act(SetDriver{page.name});
  publishTeam();
}

void ConsoleSession::reply(Page& page, const std::string& json) {
  if (page.is_leaving) return;
  if (page.outbox.reply(json)) {
    act(WakePage{page.id});
  } else {
    disconnect(page, "too many messages whose replies were not read; wait for each reply");
  }
}

void ConsoleSession::noteToAll(const std::string& json) {
  const auto message = std::make_shared<const WebMessage>(WebMessage::text(json));
  for (auto& [id, page] : pages_) {
    if (!page.is_admitted || page.is_leaving) continue;
    page.outbox.note(message);
    act(WakePage{id});
  }
}

/// Revokes from every page what its token, which may have been withdrawn or expired, no longer permits.
void ConsoleSession::checkAccess(std::uint64_t version) {
  if (std::exchange(access_version_, version) == version) return;
  for (auto& [id, page] : pages_) {
    if (!page.is_admitted || page.is_leaving) continue;
    if (!mayJoin(access_, page.client)) {
      release(page, page.name + "'s token is no longer valid");
      reject(page, "Your token is no longer valid.");
    } else if (lock_.holder == id && !mayDrive(access_, page.client, primary())) {
      release(page, page.name + "'s token no longer permits driving");
    }
    if (page.outbox.subscription().map && !mayLook(access_, page.client)) page.outbox.subscribeMap(false);
  }
  watchMap();
}

void ConsoleSession::checkDeadlines(Time now) {
  for (auto& [id, page] : pages_) {
    if (isSilent(page) && now - page.opened > kHelloWithin) {
      disconnect(page, "no hello within 10 s; the first message must be a hello, sent at once");
    }
    if (page.outbox.isStuck(now)) disconnect(page, "no update acknowledged for 6 s");
  }
}

/// @return whether the primary has a new update or description
bool ConsoleSession::takeRobots(const std::vector<TeamRobot>& robots) {
  const std::string former_primary = primary();
  robots_ = robots;
  finishSwitch();
  if (robots_.empty()) return false;
  const RobotNews before = std::exchange(feed_.primary, robots_.front().news);
  const RobotNews& now = feed_.primary;
  if (primary() != former_primary) answers_ = now.answers;  // those that it sent when it was the primary before
  bool is_news = now.update != before.update;
  if (now.info && now.info != before.info) is_news |= feed_.robot.set(robotJson(*now.info, now.period_s));
  return is_news;
}

void ConsoleSession::finishSwitch() {
  const auto finished = std::exchange(pending_switch_, std::nullopt);
  Page* page = finished ? find(finished->page) : nullptr;
  if (!page) return;
  if (primary() == finished->robot) {
    audit(*page, "switch to " + primary());
  } else {
    reply(*page, noteJson(finished->robot + " cannot be driven now.", true));
  }
}

/// Reports the team's events since the last update. Stop reasons are logged by the robots, and the winner is shown in
/// the page's banner.
void ConsoleSession::reportEvents() {
  using Kind = TeamEvents::Kind;
  for (const auto& note : events_.news(robots_)) {
    if (note.kind != Kind::won) noteToAll(noteJson(note.text, note.kind != Kind::up, note.detail));
    if (note.kind != Kind::stopped && note.kind != Kind::too_far) act(WriteLog{{}, note.line()});
  }
}

void ConsoleSession::reportAnswers() {
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const auto& answer = feed_.primary.answers[i];
    if (!answer || answer == answers_[i]) continue;
    answers_[i] = answer;
    noteToAll(answerJson(nameOf(readingRow(i).sensor), *answer));
  }
}

void ConsoleSession::wakeAdmittedPages() {
  for (const auto& [id, page] : pages_) {
    if (page.is_admitted) act(WakePage{id});
  }
}

void ConsoleSession::publishTeam() {
  if (robots_.empty()) return;  // not before the first update()
  lock_.pages = static_cast<std::size_t>(std::count_if(pages_.begin(), pages_.end(), [](const auto& page) {
    return page.second.is_admitted && !page.second.is_leaving;
  }));
  if (!feed_.team.set(teamJson(robots_, lock_))) return;
  wakeAdmittedPages();
}

void ConsoleSession::publishVitals(Time now) {
  if (robots_.empty() || now - vitals_published_ < kVitalsPeriod) return;
  vitals_published_ = now;
  if (!feed_.vitals.set(vitalsJson(robots_))) return;
  wakeAdmittedPages();
}

void ConsoleSession::takeRun(const RunView& run) {
  const RunView former = std::exchange(run_, run);
  const auto report = [&](const std::string& what, const std::string& problem, const std::string& former_problem) {
    if (problem.empty() || problem == former_problem) return;
    noteToAll(noteJson(what + ".", true, problem));
    act(WriteLog{{}, what + ": " + problem});
  };
  report("The next run could not be started", run.restart_problem, former.restart_problem);
  report("The recording could not be changed", run.recording.problem, former.recording.problem);
  report("The recording has ended early", run.recording.failure, former.recording.failure);
  const bool is_over = run.phase == RunView::Phase::ended || (!robots_.empty() && robots_.front().news.is_over);
  if (!std::exchange(was_over_, is_over) && is_over) noteToAll(noteJson("The run is over.", false));
  if (!feed_.run.set(runJson(run))) return;
  wakeAdmittedPages();
}

/// @return whether the map has changed
bool ConsoleSession::takeMap(const std::shared_ptr<const MapView>& map) {
  if (!is_map_watched_ || !map || map == feed_.poses) return false;
  const bool is_first = !feed_.poses;
  if (is_first || map->world != feed_.poses->world || map->problem != feed_.poses->problem) {
    feed_.map.message.reset();  // also an equal map is sent: pages may show its objects at other places
    feed_.map.set(mapJson(*map));
  }
  feed_.poses = map;
  return true;
}

/// Starts or stops the map when the first page subscribes to it or the last one no longer does.
void ConsoleSession::watchMap() {
  const bool watched = std::any_of(pages_.begin(), pages_.end(), [](const auto& page) {
    return page.second.outbox.subscription().map && !page.second.is_leaving;
  });
  if (std::exchange(is_map_watched_, watched) != watched) act(WatchMap{watched});
}

/// Wakes the pages, the holder of the control lock first. Without news, only pages that lack the newest state.
void ConsoleSession::wakePages(bool is_news, Time now) {
  if (lock_.holder != 0) act(WakePage{lock_.holder});
  for (const auto& [id, page] : pages_) {
    if (is_news || page.outbox.isUpdateDue(feed_, now) || page.outbox.isPulseDue(now)) act(WakePage{id});
  }
}

void ConsoleSession::audit(const Page& page, const std::string& action) {
  act(WriteAudit{page.client, page.peer, action + " (page of " + page.name + ")"});
}

ConsoleActions ConsoleSession::takeActions() { return std::exchange(actions_, {}); }

}  // namespace robosim
