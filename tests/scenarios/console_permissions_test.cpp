// Checks every message of the console's pages, for every role and for permitted and forbidden robots, against the table
// in doc/security.md. Messages are enumerated from the parser's list, so that a new one without a table row or an
// example here fails.
#include <atomic>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "console/console.h"
#include "console/page_message.h"
#include "console/testing/test_page.h"
#include "remote/testing/test_robot.h"
#include "tests/scenarios/permission_table.h"

namespace robosim {
namespace {

const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "primary-0123456789abcdef robot Ann\n"
    "other-0123456789abcdef robot Bob\n"
    "both-0123456789abcdef robot Ann Bob\n"
    "geometry-0123456789abcdef geometry\n"
    "operator-0123456789abcdef operator\n"
    "expired-0123456789abcdef operator expires=2020-01-31\n";

/// The table's columns, with a token for each.
const std::map<std::string, std::string>& columns() {
  static const std::map<std::string, std::string> all{{"viewer", "viewer-0123456789abcdef"},
                                                      {"robot: the primary only", "primary-0123456789abcdef"},
                                                      {"robot: others only", "other-0123456789abcdef"},
                                                      {"robot: primary and next", "both-0123456789abcdef"},
                                                      {"operator", "operator-0123456789abcdef"}};
  return all;
}

/// A map that records whether a page was permitted to request it.
struct NoMap final : MapSource {
  void setWatched(bool watched) override { is_watched = watched; }
  std::shared_ptr<const MapView> newest() override { return view; }
  std::atomic<bool> is_watched{false};
  std::shared_ptr<const MapView> view = std::make_shared<MapView>();
};

/// A run that permits all requests, and stores whether a page was permitted to start the next one, and to record it.
struct RequestedRun final : RunSource {
  RunView newest() override {
    return {.phase = RunView::Phase::ended,
            .may_restart = true,
            .recording = {.state = RecordingView::State::off, .may_change = true}};
  }
  void restart(bool) override { is_restarted = true; }
  void resume() override {}
  void setRecording(bool on) override { is_recorded = on; }
  std::atomic<bool> is_restarted{false}, is_recorded{false};
};

/// A console with Ann, the primary, and Bob.
class Team {
 public:
  Team() {
    std::vector<RobotAddress> list;
    for (TestRobot* robot : {&ann, &bob}) {
      list.push_back({robot->robot.name(), "127.0.0.1", static_cast<std::uint16_t>(robot->port()), list.empty()});
    }
    Console::Options options;
    options.listen = "127.0.0.1:0";
    options.access = Access::parse(kTokens, "tokens");
    options.map = &map;
    options.run = &run;
    console_ = std::make_unique<Console>(options, list);
    thread_ = std::thread([this] { console_->serve([this] { return is_over_.load(); }); });
  }
  ~Team() {
    is_over_ = true;
    thread_.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void wait(TestPage& page, const std::function<bool()>& until, const CallSite& place = CallSite::here()) {
    const auto step_and_receive = [&] {
      step();
      page.receive();
    };
    waitUntil(until, step_and_receive, place);
  }
  void step() {
    ann.step();
    bob.step();
  }
  int port() const { return console_->port(); }

  TestRobot ann{"Ann"}, bob{"Bob"};
  NoMap map;
  RequestedRun run;

 private:
  std::atomic<bool> is_over_{false};
  std::unique_ptr<Console> console_;
  std::thread thread_;
};

/// The latest team message of a page; empty for none.
std::string newestTeam(const TestPage& page) {
  for (auto text = page.texts.rbegin(); text != page.texts.rend(); ++text) {
    if (text->find(R"("type":"team")") != std::string::npos) return *text;
  }
  return "";
}
bool isTeamUp(const TestPage& page) {
  const std::string team = newestTeam(page);
  return !team.empty() && team.find(R"("up":false)") == std::string::npos;
}
bool hasControl(const TestPage& page) {
  return newestTeam(page).find(R"("control_lock":{"holder":0)") == std::string::npos;
}
std::string primaryOf(const TestPage& page) {
  const std::string team = newestTeam(page), before = R"("robots":[{"name":")";
  const auto at = team.find(before) + before.size();
  return team.substr(at, team.find('"', at) - at);
}

/// A message, and a check of its effect.
struct Example {
  std::string json;
  std::function<bool(Team&, TestPage&)> has_effect;  ///< null for a message without visible effect
  std::string before{};                              ///< message to send first
};

bool isSpeed(Team& team, int sign) {
  const double speed_mps = team.ann.hardware->lastCommand().speed_mps;
  return speed_mps * sign > 0;
}
bool isTurn(Team& team, int sign) { return team.ann.hardware->lastCommand().turn_radps * sign > 0; }

const std::map<std::string, Example>& examples() {
  static const auto answers = [](const char* sensor) {
    return [sensor](Team&, TestPage& page) { return page.has(R"("sensor":")" + std::string(sensor)); };
  };
  static const std::map<std::string, Example> all{
      {"hello", {R"({"type":"hello","protocol":1})", [](Team&, TestPage& p) { return p.countOf("welcome") > 1; }}},
      {"ack", {R"({"type":"ack","number":0})", nullptr}},
      {"ping", {R"({"type":"ping","number":7})", [](Team&, TestPage& p) { return p.has(R"("pong","number":7)"); }}},
      {"live", {R"({"type":"live","on":false})", nullptr}},
      {"map", {R"({"type":"map","on":true})", [](Team& t, TestPage&) { return t.map.is_watched.load(); }}},
      {"take", {R"({"type":"take"})", [](Team&, TestPage& p) { return hasControl(p); }}},
      {"release", {R"({"type":"release"})", [](Team&, TestPage& p) { return !hasControl(p); }}},
      {"accelerate", {R"({"type":"accelerate"})", [](Team& t, TestPage&) { return isSpeed(t, 1); }}},
      {"decelerate", {R"({"type":"decelerate"})", [](Team& t, TestPage&) { return isSpeed(t, -1); }}},
      {"turn_left", {R"({"type":"turn_left"})", [](Team& t, TestPage&) { return isTurn(t, 1); }}},
      {"turn_right", {R"({"type":"turn_right"})", [](Team& t, TestPage&) { return isTurn(t, -1); }}},
      {"drive", {R"({"type":"drive","speed":1})", [](Team& t, TestPage&) { return isSpeed(t, 1); }}},
      {"stop",
       {R"({"type":"stop"})", [](Team& t, TestPage&) { return t.ann.hardware->lastCommand().speed_mps == 0; },
        R"({"type":"drive","speed":1})"}},
      {"alive", {R"({"type":"alive"})", nullptr}},
      {"check_win", {R"({"type":"check_win"})", [](Team& t, TestPage&) { return t.ann.hardware->win_checks > 0; }}},
      {"autonomous",
       {R"({"type":"autonomous","on":true})", [](Team& t, TestPage&) { return t.ann.robot.state().autonomous(); }}},
      {"switch", {R"({"type":"switch"})", [](Team&, TestPage& p) { return primaryOf(p) == "Bob"; }}},
      {"switch to the next robot",
       {R"({"type":"switch","robot":"Bob"})", [](Team&, TestPage& p) { return primaryOf(p) == "Bob"; }}},
      {"play_again", {R"({"type":"play_again"})", [](Team& t, TestPage&) { return t.run.is_restarted.load(); }}},
      {"record", {R"({"type":"record","on":true})", [](Team& t, TestPage&) { return t.run.is_recorded.load(); }}},
      {"join", {R"({"type":"join"})", nullptr}},
      {"leave", {R"({"type":"leave"})", nullptr}},
      {"start", {R"({"type":"start"})", nullptr}},
      {"skip", {R"({"type":"skip"})", nullptr}},
      {"req_heat", {R"({"type":"req_heat"})", answers("heat")}},
      {"req_laser", {R"({"type":"req_laser"})", answers("laser")}},
      {"req_sonar",
       {R"({"type":"req_sonar"})", [](Team&, TestPage& p) { return p.countOf(R"("sensor":"sonar")") > 1; }}},
  };
  return all;
}

/// The state that messages may change, except for what pages display.
std::string stateOf(Team& team) {
  std::string text;
  for (TestRobot* robot : {&team.ann, &team.bob}) {
    const v1::RobotState state = robot->robot.state();
    const Command command = robot->hardware->lastCommand();
    text += state.driver() + (state.autonomous() ? " autonomous " : " driven ") + std::to_string(command.speed_mps) +
            " " + std::to_string(command.turn_radps) + " " + std::to_string(robot->hardware->win_checks) + "\n";
  }
  return text + (team.map.is_watched ? "map" : "") + (team.run.is_restarted ? "restarted" : "") +
         (team.run.is_recorded ? "recorded" : "");
}

/// Waits until preceding messages have reached the primary: an answer follows them.
void settle(Team& team, TestPage& page) {
  const auto answers = page.countOf(R"("type":"answer")");
  page.send(R"({"type":"req_sonar"})");
  team.wait(page, [&] { return page.countOf(R"("type":"answer")") > answers; });
  for (int i = 0; i < 3; ++i) team.step();
}

std::unique_ptr<TestPage> pageOf(Team& team, const std::string& token) {
  auto page = std::make_unique<TestPage>(team.port());
  page->hello(token);
  team.wait(*page, [&] { return isTeamUp(*page); });
  return page;
}

TEST(ConsolePermissions, MatchTheTableForEveryMessageAndRole) {
  const PermissionTable table = permissionTable("message");
  for (const auto& [name, row] : table)
    EXPECT_TRUE(examples().contains(name)) << "doc/security.md has no longer " << name;
  for (const auto& row : pageMessageRows()) {
    EXPECT_TRUE(examples().contains(row.name)) << "give an example of " << row.name << " here";
  }
  auto shared = std::make_unique<Team>();  // for pages without permission to drive, which do not change it
  for (const auto& entry : examples()) {
    const std::string& name = entry.first;
    const auto& example = entry.second;  // clang 14 cannot capture structured bindings
    ASSERT_TRUE(table.contains(name)) << "doc/security.md: add a row for " << name;
    for (const auto& [column, token] : columns()) {
      SCOPED_TRACE(name + ", " + column);
      const bool is_allowed = table.at(name).at(column) == "yes";
      const bool may_drive = table.at("take").at(column) == "yes";
      std::unique_ptr<Team> own;
      if (may_drive || (is_allowed && example.has_effect)) own = std::make_unique<Team>();
      Team& team = own ? *own : *shared;
      const auto page = pageOf(team, token);
      if (name != "take") {
        page->send(R"({"type":"take"})");
        if (may_drive) team.wait(*page, [&] { return hasControl(*page); });
      }
      if (!example.before.empty()) page->send(example.before);
      settle(team, *page);
      const std::string before = stateOf(team);
      page->send(example.json);
      if (is_allowed && example.has_effect) {
        team.wait(*page, [&] { return example.has_effect(team, *page); });
      } else {
        settle(team, *page);
      }
      if (!is_allowed) {
        EXPECT_EQ(stateOf(team), before);
        EXPECT_EQ(primaryOf(*page), "Ann");
        EXPECT_EQ(hasControl(*page), may_drive && name != "take");
      }
      EXPECT_FALSE(page->is_closed) << page->why_closed;
    }
  }
}

TEST(ConsolePermissions, RejectEveryMessageOfAPageWithoutAValidToken) {
  Team team;
  {
    const auto page = pageOf(team, "viewer-0123456789abcdef");
    settle(team, *page);
  }
  const std::string before = stateOf(team);
  for (const auto& [name, example] : examples()) {
    for (const char* token : {"", "wrong-0123456789abcdef", "expired-0123456789abcdef", "geometry-0123456789abcdef"}) {
      SCOPED_TRACE(name + " with the token '" + token + "'");
      TestPage page(team.port());
      page.hello(token);
      page.send(example.json);
      team.wait(page, [&] { return page.is_closed; });
      EXPECT_TRUE(page.has(R"("type":"refused")"));
      EXPECT_EQ(page.texts.size(), 1u) << "it receives nothing else";
    }
    if (name == "hello") continue;
    TestPage page(team.port());
    page.send(example.json);
    team.wait(page, [&] { return page.is_closed; });
    EXPECT_EQ(page.why_closed, "the first message of a page must be its hello") << name;
  }
  EXPECT_EQ(stateOf(team), before);
}

}  // namespace
}  // namespace robosim
