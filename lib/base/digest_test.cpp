#include "base/digest.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Digest, OfNothingIsXxh3OfNothing) {
  // The value that the xxHash project gives for XXH3_64bits of no bytes with seed 0.
  EXPECT_EQ(Digest().text(), "2d06800538d394c2");
}

TEST(Digest, DependsOnTheBytesAndTheirOrderNotOnHowTheyWereCut) {
  Digest whole, cut, swapped;
  whole.addBytes("abcdef", 6);
  cut.addBytes("abc", 3);
  cut.addBytes("def", 3);
  swapped.addBytes("defabc", 6);
  EXPECT_EQ(whole.value(), cut.value());
  EXPECT_NE(whole.value(), swapped.value());
}

TEST(Digest, CanBeReadHalfwayWithoutBeingDisturbed) {
  Digest read, unread;
  for (int i = 0; i < 1000; ++i) {
    read.add(i * 0.5);
    unread.add(i * 0.5);
    read.value();
  }
  EXPECT_EQ(read.text(), unread.text());
  EXPECT_EQ(read.text().size(), 16u);
}

TEST(Digest, TellsNumbersApartByOneBit) {
  Digest one, other;
  one.add(1.0);
  other.add(1.0 + 0x1p-52);
  EXPECT_NE(one.value(), other.value());
}

}  // namespace
}  // namespace robosim
