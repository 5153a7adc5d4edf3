#include "console/order_limiter.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

struct OrderLimiterTest : testing::Test {
  OrderLimiter limiter;
  OrderLimiter::Time now{1h};

  /// Names of the orders that are sent for one order.
  std::vector<OrderType> sent(const v1::ControlRequest& order) {
    std::vector<OrderType> types;
    for (const auto& one : limiter.add(order, now)) types.push_back(typeOf(one));
    return types;
  }
  std::vector<OrderType> sent(OrderType type) { return sent(makeOrder(type)); }
};

using Types = std::vector<OrderType>;

TEST_F(OrderLimiterTest, SendsTheFirstOrderAtOnce) {
  EXPECT_EQ(sent(OrderType::accelerate), Types{OrderType::accelerate});
  EXPECT_FALSE(limiter.due(now));
}

TEST_F(OrderLimiterTest, DelaysTheNextOrderUntilThePauseIsOver) {
  sent(OrderType::accelerate);
  now += 9ms;
  EXPECT_EQ(sent(OrderType::turn_left), Types{});
  EXPECT_FALSE(limiter.due(now));
  now += 1ms;
  EXPECT_EQ(typeOf(*limiter.due(now)), OrderType::turn_left);
  EXPECT_FALSE(limiter.due(now + 1h)) << "once";
}

TEST_F(OrderLimiterTest, OfManyOrdersSendsTheNewest) {
  sent(OrderType::accelerate);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(sent(OrderType::turn_left), Types{});
  EXPECT_EQ(sent(OrderType::turn_right), Types{});
  now += OrderLimiter::kPause;
  EXPECT_EQ(typeOf(*limiter.due(now)), OrderType::turn_right);
}

TEST_F(OrderLimiterTest, MergesDriveOrdersByField) {
  sent(OrderType::accelerate);
  sent(driveOrder(0.5, 0.25));
  sent(driveOrder(0.0));
  sent(driveOrder({}, 1.0));
  now += OrderLimiter::kPause;
  const auto order = limiter.due(now);
  EXPECT_EQ(order->drive().speed_mps(), 0.0);
  EXPECT_EQ(order->drive().turn_radps(), 1.0);
}

TEST_F(OrderLimiterTest, SendsADriveOrderBeforeAnotherOrderThatFollowsIt) {
  sent(OrderType::accelerate);
  sent(driveOrder(0.0));
  EXPECT_EQ(sent(OrderType::turn_left), Types{OrderType::drive});
  now += OrderLimiter::kPause;
  EXPECT_EQ(typeOf(*limiter.due(now)), OrderType::turn_left);
}

TEST_F(OrderLimiterTest, SendsAStopAtOnceAndDiscardsWhatWaits) {
  sent(OrderType::accelerate);
  sent(driveOrder(1.0));
  EXPECT_EQ(sent(OrderType::stop), Types{OrderType::stop});
  now += 1h;
  EXPECT_FALSE(limiter.due(now));
}

TEST_F(OrderLimiterTest, SendsAliveAndCheckWinAtOnceAndKeepsWhatWaits) {
  sent(OrderType::accelerate);
  sent(driveOrder(1.0));
  EXPECT_EQ(sent(OrderType::alive), Types{OrderType::alive});
  EXPECT_EQ(sent(OrderType::check_win), Types{OrderType::check_win});
  now += OrderLimiter::kPause;
  EXPECT_EQ(typeOf(*limiter.due(now)), OrderType::drive);
}

TEST_F(OrderLimiterTest, DelaysOnlyOrdersThatSteer) {
  for (const OrderRow& row : kOrders) {
    limiter.clear();
    now += OrderLimiter::kPause;
    sent(OrderType::accelerate);
    const bool waits = row.rule == OrderRule::set || row.rule == OrderRule::steer;
    EXPECT_EQ(sent(row.type), waits ? Types{} : Types{row.type}) << row.name;
    now += OrderLimiter::kPause;
    EXPECT_EQ(limiter.due(now).has_value(), waits) << row.name;
  }
}

TEST_F(OrderLimiterTest, ClearDiscardsWhatWaits) {
  sent(OrderType::accelerate);
  sent(driveOrder(1.0));
  limiter.clear();
  now += 1h;
  EXPECT_FALSE(limiter.due(now));
}

}  // namespace
}  // namespace robosim
