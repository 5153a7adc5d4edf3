#include "net/lookout.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

void sleepTimes(Lookout& lookout, int times, Lookout::Duration wait) {
  for (int i = 0; i < times; ++i) lookout.slept(wait);
}

/// How many times one must have slept and been woken soon, before it is worthwhile to look out.
int sleepsUntilWorthwhile(Lookout lookout) {
  int sleeps = 0;
  for (; !lookout.isWorthwhile(); ++sleeps) lookout.slept(microseconds(50));
  return sleeps;
}

void failAtOnce(Lookout& lookout) {
  sleepTimes(lookout, sleepsUntilWorthwhile(lookout), microseconds(50));
  lookout.failed();
}

TEST(Lookout, IsWorthwhileOnceThreeMessagesInARowHaveComeSoon) {
  Lookout lookout;
  EXPECT_EQ(sleepsUntilWorthwhile(lookout), 3);
  sleepTimes(lookout, 2, microseconds(50));
  lookout.slept(milliseconds(20));
  EXPECT_EQ(sleepsUntilWorthwhile(lookout), 3);
}

TEST(Lookout, StaysWorthwhileWhileMessagesCome) {
  Lookout lookout;
  sleepTimes(lookout, 3, microseconds(50));
  for (int i = 0; i < 1000; ++i) lookout.succeeded();
  EXPECT_TRUE(lookout.isWorthwhile());
}

TEST(Lookout, IsNotWorthwhileWhereMessagesLetOneWait) {
  Lookout lookout;
  sleepTimes(lookout, 1000, milliseconds(1));
  EXPECT_FALSE(lookout.isWorthwhile());
}

TEST(Lookout, LearnsNothingFromMessagesThatWereThereAlready) {
  Lookout lookout;
  sleepTimes(lookout, 1000, microseconds(1));
  EXPECT_FALSE(lookout.isWorthwhile());
  sleepTimes(lookout, 3, microseconds(50));
  lookout.slept(microseconds(1));
  EXPECT_TRUE(lookout.isWorthwhile());
}

TEST(Lookout, IsPutOffTwiceAsLongEachTimeItIsInVain) {
  Lookout lookout;
  for (const int sleeps : {64, 128, 256, 512}) {
    failAtOnce(lookout);
    EXPECT_EQ(sleepsUntilWorthwhile(lookout), sleeps);
  }
  for (int i = 0; i < 20; ++i) failAtOnce(lookout);
  EXPECT_EQ(sleepsUntilWorthwhile(lookout), 8192);
}

TEST(Lookout, IsPutOffForAShortTimeWhenItHasBeenGoodForLong) {
  Lookout lookout;
  for (int i = 0; i < 5; ++i) failAtOnce(lookout);
  sleepTimes(lookout, sleepsUntilWorthwhile(lookout), microseconds(50));
  for (int i = 0; i < 1000; ++i) lookout.succeeded();
  lookout.failed();
  EXPECT_EQ(sleepsUntilWorthwhile(lookout), 64);
}

}  // namespace
}  // namespace robosim
