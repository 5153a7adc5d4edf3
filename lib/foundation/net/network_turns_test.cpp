#include "net/network_turns.h"

#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(NetworkTurns, GoFromNetworkToNetworkAndFromTheNewestToTheOldest) {
  NetworkTurns turns;
  for (const NetworkTurns::Number number : {2, 3, 4}) turns.add(number, "127.0.0.0/24");
  turns.add(5, "192.0.2.7");
  turns.add(6, "2001:db8::/64");
  turns.remove(6);
  turns.remove(7);
  std::vector<NetworkTurns::Number> order;
  while (const auto number = turns.next()) order.push_back(*number);
  EXPECT_EQ(order, (std::vector<NetworkTurns::Number>{4, 5, 3, 2}));
  EXPECT_TRUE(turns.isEmpty());
}

}  // namespace
}  // namespace robosim
