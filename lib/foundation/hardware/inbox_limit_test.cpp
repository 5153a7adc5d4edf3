#include "hardware/inbox_limit.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(InboxLimit, AdmitsAsManyMessagesAsTheLimit) {
  InboxLimit limit;
  for (std::size_t i = 0; i < InboxLimit::kMaxMessages; ++i) EXPECT_TRUE(limit.admit("a", "b", "")) << i;
  EXPECT_FALSE(limit.admit("a", "b", ""));
}

TEST(InboxLimit, CountsTheBytesOfBothNamesAndTheText) {
  // 64 messages of 4096 bytes, both names included, are the 256 KiB exactly.
  const std::string from(100, 'a'), to(200, 'b'), text(3796, 'x');
  InboxLimit limit;
  for (int i = 0; i < 63; ++i) EXPECT_TRUE(limit.admit(from, to, text)) << i;
  EXPECT_FALSE(limit.admit(from, to, text + "y")) << "a byte more";
  EXPECT_TRUE(limit.admit(from, to, text)) << "the refused message does not count";
  EXPECT_FALSE(limit.admit("", "", "x"));
}

}  // namespace
}  // namespace robosim
