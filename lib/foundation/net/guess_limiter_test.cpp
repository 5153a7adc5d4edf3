#include "net/guess_limiter.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

struct GuessLimiterTest : testing::Test {
  GuessLimiter limiter;
  GuessLimiter::Time now{1'000'000h};
  int guesses = 0;

  void guess(const std::string& address = "192.0.2.7") {
    limiter.noteWrong(address, computeHash("wrong" + std::to_string(++guesses)), now);
  }
  auto waitOf(const std::string& token, const std::string& address = "192.0.2.7") const {
    return limiter.wait(address, computeHash(token), now);
  }
};

TEST_F(GuessLimiterTest, DoublesTheBlockingTimeWithEachWrongTokenUpToFiveSeconds) {
  for (int i = 0; i < 5; ++i) guess();
  EXPECT_EQ(waitOf("next"), 0ms);
  for (const auto wait : {250ms, 500ms, 1000ms, 2000ms, 4000ms, 5000ms, 5000ms}) {
    guess();
    EXPECT_EQ(waitOf("next"), wait);
    EXPECT_EQ(waitOf("next", "192.0.2.8"), 0ms) << "another address";
  }
  now += 4999ms;
  EXPECT_EQ(waitOf("next"), 1ms);
  now += 1ms;
  EXPECT_EQ(waitOf("next"), 0ms);
}

TEST_F(GuessLimiterTest, ExemptsTokensThatWereAcceptedFromTheAddressBefore) {
  limiter.noteRight("192.0.2.7", computeHash("right"), now);
  for (int i = 0; i < 20; ++i) guess();
  EXPECT_EQ(waitOf("right"), 0ms);
  EXPECT_EQ(waitOf("other"), 5000ms);
}

TEST_F(GuessLimiterTest, CountsARepeatedWrongTokenOnce) {
  for (int i = 0; i < 100; ++i) limiter.noteWrong("192.0.2.7", computeHash("withdrawn"), now);
  EXPECT_EQ(waitOf("next"), 0ms);
}

TEST_F(GuessLimiterTest, DropsEntriesOneMinuteAfterTheLastGuess) {
  for (int i = 0; i < 20; ++i) guess();
  now += 61s;
  guess();
  EXPECT_EQ(waitOf("next"), 0ms);
}

TEST_F(GuessLimiterTest, LimitsTheBlockingTimeWhenTheClockIsSetBack) {
  for (int i = 0; i < 20; ++i) guess();
  now -= 1h;
  EXPECT_EQ(waitOf("next"), 0ms);
}

TEST_F(GuessLimiterTest, KeepsABoundedNumberOfAddresses) {
  for (std::size_t i = 0; i < 2 * GuessLimiter::kMaxAddresses; ++i) {
    now += 1ms;
    guess(std::to_string(i));
  }
  EXPECT_EQ(limiter.addresses(), GuessLimiter::kMaxAddresses);
}

TEST(AddressOf, DropsThePortAndTheHostPartOfIpv6) {
  EXPECT_EQ(addressOf("ipv4:192.0.2.7:4711"), "192.0.2.7");
  EXPECT_EQ(addressOf("192.0.2.7"), "192.0.2.7");
  EXPECT_EQ(addressOf("::ffff:192.0.2.7"), "192.0.2.7");
  for (const char* peer : {"ipv6:[2001:db8:1:2:3:4:5:6]:80", "ipv6:%5B2001:db8:1:2:aaaa::%5D:80", "2001:db8:1:2::9"}) {
    EXPECT_EQ(addressOf(peer), "2001:db8:1:2::") << peer;
  }
  EXPECT_EQ(addressOf("fe80::1%eth0"), "fe80::");
}

}  // namespace
}  // namespace robosim
