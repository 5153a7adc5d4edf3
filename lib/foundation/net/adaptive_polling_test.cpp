#include "net/adaptive_polling.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

void recordSleeps(AdaptivePolling& polling, int times, AdaptivePolling::Duration wait) {
  for (int i = 0; i < times; ++i) polling.recordSleep(wait);
}

/// Number of short waits after which polling is enabled.
int sleepsUntilPolling(AdaptivePolling polling) {
  int sleeps = 0;
  for (; !polling.shouldPoll(); ++sleeps) polling.recordSleep(microseconds(50));
  return sleeps;
}

void timeOutNextPoll(AdaptivePolling& polling) {
  recordSleeps(polling, sleepsUntilPolling(polling), microseconds(50));
  polling.recordPollTimeout();
}

TEST(AdaptivePolling, PollsAfterThreeConsecutiveShortWaits) {
  AdaptivePolling polling;
  EXPECT_EQ(sleepsUntilPolling(polling), 3);
  recordSleeps(polling, 2, microseconds(50));
  polling.recordSleep(milliseconds(20));
  EXPECT_EQ(sleepsUntilPolling(polling), 3);
}

TEST(AdaptivePolling, KeepsPollingWhileMessagesArrive) {
  AdaptivePolling polling;
  recordSleeps(polling, 3, microseconds(50));
  for (int i = 0; i < 1000; ++i) polling.recordPollSuccess();
  EXPECT_TRUE(polling.shouldPoll());
}

TEST(AdaptivePolling, DoesNotPollAfterLongWaits) {
  AdaptivePolling polling;
  recordSleeps(polling, 1000, milliseconds(1));
  EXPECT_FALSE(polling.shouldPoll());
}

TEST(AdaptivePolling, IgnoresMessagesThatWereAlreadyQueued) {
  AdaptivePolling polling;
  recordSleeps(polling, 1000, microseconds(1));
  EXPECT_FALSE(polling.shouldPoll());
  recordSleeps(polling, 3, microseconds(50));
  polling.recordSleep(microseconds(1));
  EXPECT_TRUE(polling.shouldPoll());
}

TEST(AdaptivePolling, DoublesTheBackoffAfterEachTimeout) {
  AdaptivePolling polling;
  for (const int sleeps : {64, 128, 256, 512}) {
    timeOutNextPoll(polling);
    EXPECT_EQ(sleepsUntilPolling(polling), sleeps);
  }
  for (int i = 0; i < 20; ++i) timeOutNextPoll(polling);
  EXPECT_EQ(sleepsUntilPolling(polling), 8192);
}

TEST(AdaptivePolling, ResetsTheBackoffAfterManySuccesses) {
  AdaptivePolling polling;
  for (int i = 0; i < 5; ++i) timeOutNextPoll(polling);
  recordSleeps(polling, sleepsUntilPolling(polling), microseconds(50));
  for (int i = 0; i < 1000; ++i) polling.recordPollSuccess();
  polling.recordPollTimeout();
  EXPECT_EQ(sleepsUntilPolling(polling), 64);
}

}  // namespace
}  // namespace robosim
