// The console over real connections: pages with and without a token, and robots of a team behind real remote ports.
#include "console/console.h"

#include <atomic>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "console/testing/one_robot_map.h"
#include "console/testing/test_page.h"
#include "net/testing/address_flood.h"
#include "remote/testing/test_robot.h"

namespace robosim {
namespace {

const char* const kViewer = "viewer-0123456789abcdef";
const char* const kOnlyBob = "only-bob-0123456789abcdef";
const char* const kAnnAndBob = "ann-and-bob-0123456789abcdef";
const char* const kOperator = "operator-0123456789abcdef";
const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "only-bob-0123456789abcdef robot Bob\n"
    "ann-and-bob-0123456789abcdef robot Ann Bob\n"
    "operator-0123456789abcdef operator\n";

class TestMap : public MapSource {
 public:
  void setWatched(bool watched) override { is_watched = watched; }
  std::shared_ptr<const MapView> newest() override { return view_; }
  std::atomic<bool> is_watched{false};

 private:
  std::shared_ptr<const MapView> view_ = oneRobotMap();
};

/// Ann, the primary, Bob and Cid.
struct ConsoleTest : testing::Test {
  std::vector<std::unique_ptr<TestRobot>> team;
  TestMap map;
  std::unique_ptr<Console> console;
  std::atomic<bool> is_over{false};
  std::thread thread;
  std::vector<std::unique_ptr<TestPage>> pages;
  std::mutex log_mutex;
  std::string log;

  std::string logText() {
    const std::lock_guard lock(log_mutex);
    return log;
  }

  ConsoleTest() {
    std::vector<RobotAddress> list;
    for (const char* name : {"Ann", "Bob", "Cid"}) {
      team.push_back(std::make_unique<TestRobot>(name));
      list.push_back({name, "127.0.0.1", static_cast<std::uint16_t>(team.back()->port()), list.empty()});
    }
    Console::Options options;
    options.listen = "127.0.0.1:0";
    options.access = Access::parse(kTokens, "tokens");
    options.map = &map;
    options.log = [this](const std::string& line) {
      const std::lock_guard lock(log_mutex);
      log += line + "\n";
    };
    console = std::make_unique<Console>(options, list);
    thread = std::thread([this] { console->serve([this] { return is_over.load(); }); });
  }
  ~ConsoleTest() override {
    is_over = true;
    thread.join();
    console.reset();
  }

  void wait(const std::function<bool()>& until, const CallSite& place = CallSite::here()) {
    const auto step = [&] {
      for (auto& robot : team) robot->step();
      for (auto& page : pages) page->receive();
    };
    waitUntil(until, step, place);
  }
  /// A page whose hello was accepted, when all robots are up.
  TestPage& page(const std::string& token) {
    pages.push_back(std::make_unique<TestPage>(console->port()));
    TestPage& page = *pages.back();
    page.hello(token);
    wait([&] { return page.has(R"("type":"welcome")") && row(page).size() == 3; });
    return page;
  }
  /// The first letters of the robots in the newest team message, the primary first; empty while one of them is down.
  static std::string row(const TestPage& page) {
    for (auto text = page.texts.rbegin(); text != page.texts.rend(); ++text) {
      if (text->find(R"("type":"team")") == std::string::npos) continue;
      if (text->find(R"("up":false)") != std::string::npos) return "";
      std::string row;
      for (auto at = text->find(R"("name":")"); at != std::string::npos; at = text->find(R"("name":")", at + 1)) {
        row += (*text)[at + 8];
      }
      return row.substr(0, 3);
    }
    return "";
  }
  void take(TestPage& page) {
    page.send(R"({"type":"take"})");
    wait([&] { return team[0]->robot.state().driver() == "Page"; });
  }
};

TEST_F(ConsoleTest, ServesPagesDuringAFloodFrom1000Addresses) {
  TestPage& before = page(kAnnAndBob);
  const AddressFlood flood(console->port(), "GET / HTTP/1.1\r\n");
  flood.waitForAll();
  TestPage& during = page(kOperator);
  take(during);
  before.send(R"({"type":"ping","number":12})");
  wait([&] { return before.has(R"({"type":"pong","number":12})"); });
  EXPECT_FALSE(before.is_closed);
}

TEST_F(ConsoleTest, SwitchesOnlyToRobotsThatTheTokenPermits) {
  TestPage& page = this->page(kAnnAndBob);
  take(page);
  page.send(R"({"type":"switch"})");
  wait([&] { return row(page).front() == 'B'; });
  EXPECT_EQ(row(page), "BCA");
  page.send(R"({"type":"switch"})");  // Cid is next in the row, and the token is not for Cid
  wait([&] { return row(page).front() != 'B'; });
  EXPECT_EQ(row(page).front(), 'A');
  page.send(R"({"type":"switch","robot":"Cid"})");
  wait([&] { return page.has("Your token is not for Cid."); });
  EXPECT_EQ(row(page).front(), 'A');
}

TEST_F(ConsoleTest, ReleasesTheControlLockOfAPageThatSendsAnInvalidFrame) {
  TestPage& page = this->page(kAnnAndBob);
  take(page);
  page.sendBinary("stop");
  wait([&] { return logText().find("release Ann: ") != std::string::npos; });
  // Not when the connection has been closed, seconds later.
  EXPECT_NE(logText().find("release Ann: Page's page was disconnected"), std::string::npos) << logText();
  wait([&] { return page.is_closed; });
  EXPECT_EQ(page.why_closed, "a binary message; messages are text");
}

TEST_F(ConsoleTest, ShowsTruePosesOnlyToTokensThatMayWatch) {
  for (const char* token : {kAnnAndBob, kOnlyBob}) {
    TestPage& page = this->page(token);
    page.send(R"({"type":"map","on":true})");
    wait([&] { return page.has("Your token does not permit the map"); });
    EXPECT_FALSE(map.is_watched);
    const std::size_t before = page.updates;
    wait([&] { return page.updates > before + 3; });
    EXPECT_FALSE(page.has("12.25")) << "a true pose";
    EXPECT_FALSE(page.has(R"("type":"map")"));
  }
  for (const char* token : {kViewer, kOperator}) {
    TestPage& page = this->page(token);
    page.send(R"({"type":"map","on":true})");
    wait([&] { return page.has("12.25"); });
  }
}

}  // namespace
}  // namespace robosim
