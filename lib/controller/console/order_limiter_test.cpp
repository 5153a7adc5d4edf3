#include "console/order_limiter.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

RemoteOrder driveAt(std::optional<double> speed_mps, std::optional<double> turn_radps = {}) {
  RemoteOrder order{.type = RemoteType::drive};
  order.speed_mps = speed_mps;
  order.turn_radps = turn_radps;
  return order;
}

struct OrderLimiterTest : testing::Test {
  OrderLimiter limiter;
  OrderLimiter::Time now{1h};

  /// Names of the orders that are sent for one order.
  std::vector<RemoteType> sent(const RemoteOrder& order) {
    std::vector<RemoteType> types;
    for (const auto& one : limiter.add(order, now)) types.push_back(one.type);
    return types;
  }
  std::vector<RemoteType> sent(RemoteType type) { return sent(RemoteOrder{.type = type}); }
};

using Types = std::vector<RemoteType>;

TEST_F(OrderLimiterTest, SendsTheFirstOrderAtOnce) {
  EXPECT_EQ(sent(RemoteType::accelerate), Types{RemoteType::accelerate});
  EXPECT_EQ(limiter.due(now), std::nullopt);
}

TEST_F(OrderLimiterTest, DelaysTheNextOrderUntilThePauseIsOver) {
  sent(RemoteType::accelerate);
  now += 9ms;
  EXPECT_EQ(sent(RemoteType::turn_left), Types{});
  EXPECT_EQ(limiter.due(now), std::nullopt);
  now += 1ms;
  EXPECT_EQ(limiter.due(now)->type, RemoteType::turn_left);
  EXPECT_EQ(limiter.due(now + 1h), std::nullopt) << "once";
}

TEST_F(OrderLimiterTest, OfManyOrdersSendsTheNewest) {
  sent(RemoteType::accelerate);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(sent(RemoteType::turn_left), Types{});
  EXPECT_EQ(sent(RemoteType::turn_right), Types{});
  now += OrderLimiter::kPause;
  EXPECT_EQ(limiter.due(now)->type, RemoteType::turn_right);
}

TEST_F(OrderLimiterTest, MergesDriveOrdersByField) {
  sent(RemoteType::accelerate);
  sent(driveAt(0.5, 0.25));
  sent(driveAt(0.0));
  sent(driveAt({}, 1.0));
  now += OrderLimiter::kPause;
  const auto order = limiter.due(now);
  EXPECT_EQ(order->speed_mps, 0.0);
  EXPECT_EQ(order->turn_radps, 1.0);
}

TEST_F(OrderLimiterTest, SendsADriveOrderBeforeAnotherOrderThatFollowsIt) {
  sent(RemoteType::accelerate);
  sent(driveAt(0.0));
  EXPECT_EQ(sent(RemoteType::turn_left), Types{RemoteType::drive});
  now += OrderLimiter::kPause;
  EXPECT_EQ(limiter.due(now)->type, RemoteType::turn_left);
}

TEST_F(OrderLimiterTest, SendsAStopAtOnceAndDiscardsWhatWaits) {
  sent(RemoteType::accelerate);
  sent(driveAt(1.0));
  EXPECT_EQ(sent(RemoteType::stop), Types{RemoteType::stop});
  now += 1h;
  EXPECT_EQ(limiter.due(now), std::nullopt);
}

TEST_F(OrderLimiterTest, SendsAliveAndCheckWinAtOnceAndKeepsWhatWaits) {
  sent(RemoteType::accelerate);
  sent(driveAt(1.0));
  EXPECT_EQ(sent(RemoteType::alive), Types{RemoteType::alive});
  EXPECT_EQ(sent(RemoteType::check_win), Types{RemoteType::check_win});
  now += OrderLimiter::kPause;
  EXPECT_EQ(limiter.due(now)->type, RemoteType::drive);
}

TEST_F(OrderLimiterTest, ClearDiscardsWhatWaits) {
  sent(RemoteType::accelerate);
  sent(driveAt(1.0));
  limiter.clear();
  now += 1h;
  EXPECT_EQ(limiter.due(now), std::nullopt);
}

}  // namespace
}  // namespace robosim
