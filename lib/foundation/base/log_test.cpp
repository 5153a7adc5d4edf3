#include "base/log.h"

#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// The records that a function writes, in a process of its own: the log's level and standard error belong to a process.
/// @param level of ROBOSIM_LOG_LEVEL; null for none
void expectRecords(const std::string& records, const std::function<void()>& write, const char* level = nullptr) {
  const auto write_all = [&] {
    level ? setenv("ROBOSIM_LOG_LEVEL", level, 1) : unsetenv("ROBOSIM_LOG_LEVEL");
    write();
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(write_all(), testing::ExitedWithCode(0), testing::Eq(records));
}

void writeEachLevel() {
  logDebug("run", "a");
  logInfo("run", "b");
  logWarning("run", "c");
  logError("", "d");
}

TEST(Log, WritesARecordPerLineWithItsSubcommand) {
  expectRecords("robosim serve: listening\nrobosim: done\n", [] {
    logInfo("serve", "listening");
    logInfo("", "done");
  });
}

TEST(Log, EscapesControlCharacters) {
  expectRecords("robosim serve: a\\x0arobosim: forged\\x1b[2J {} %v\n",
                [] { logInfo("serve", "a\nrobosim: forged\x1b[2J {} %v"); });
}

TEST(Log, DiscardsRecordsBelowItsLevel) {
  expectRecords("robosim run: b\nrobosim run: c\nrobosim: d\n", writeEachLevel);
  expectRecords("robosim run: c\nrobosim: d\n", writeEachLevel, "warning");
  expectRecords("robosim: d\n", writeEachLevel, "error");
  expectRecords("robosim run: a\nrobosim run: b\nrobosim run: c\nrobosim: d\n", [] {
    setLogLevel(LogLevel::debug);
    writeEachLevel();
  });
}

TEST(Log, ReportsAnUnknownLevel) {
  expectRecords(
      "robosim: ROBOSIM_LOG_LEVEL is 'loud\\x0a'; it must be debug, info, warning or error; using info\n"
      "robosim: a\n",
      [] { logInfo("", "a"); }, "loud\n");
}

TEST(Log, KeepsRecordsOfSeveralThreadsApart) {
  const std::string text(200, 'x');
  std::string expected;
  for (int i = 0; i < 4 * 100; ++i) expected += "robosim: " + text + "\n";
  expectRecords(expected, [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 100; ++k) logInfo("", text);
      });
    }
    for (auto& thread : threads) thread.join();
  });
}

}  // namespace
}  // namespace robosim
