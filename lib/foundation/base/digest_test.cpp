#include "base/digest.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Digest, OfNoBytesEqualsXxh3OfNoBytes) {
  // The value that the xxHash project gives for XXH3_64bits of no bytes with seed 0.
  EXPECT_EQ(Digest().text(), "2d06800538d394c2");
}

TEST(Digest, DependsOnBytesAndOrderButNotOnChunks) {
  Digest joined, cut, swapped;
  joined.addBytes("abcdef", 6);
  cut.addBytes("abc", 3);
  cut.addBytes("def", 3);
  swapped.addBytes("defabc", 6);
  EXPECT_EQ(joined.value(), cut.value());
  EXPECT_NE(joined.value(), swapped.value());
}

TEST(Digest, ReturnsIntermediateValuesWithoutSideEffects) {
  Digest read, unread;
  for (int i = 0; i < 1000; ++i) {
    read.add(i * 0.5);
    unread.add(i * 0.5);
    read.value();
  }
  EXPECT_EQ(read.text(), unread.text());
  EXPECT_EQ(read.text().size(), 16u);
}

TEST(Digest, CopiesContinueIndependently) {
  Digest original;
  for (int i = 0; i < 1000; ++i) original.add(i);
  Digest copied = original, assigned;
  assigned = original;
  EXPECT_EQ(copied, original);
  original.add(1);
  EXPECT_NE(copied, original);
  for (Digest* copy : {&copied, &assigned}) {
    copy->add(1);
    EXPECT_EQ(*copy, original);
  }
}

TEST(Digest, ContinuesFromSavedBytesAfterAnyLength) {
  // 256 bytes is the size of xxHash's buffer, 1024 that of a block of its algorithm.
  const std::string bytes(3000, 'x');
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    Digest original;
    original.addBytes(bytes.data(), size);
    std::string saved;
    original.save(saved);
    ASSERT_EQ(saved.size(), Digest::kSavedBytes);
    Digest loaded;
    ASSERT_TRUE(loaded.load(saved)) << size;
    ASSERT_EQ(loaded, original) << size;
    original.addBytes("abcdefg", 7);
    loaded.addBytes("abcdefg", 7);
    ASSERT_EQ(loaded, original) << size;
  }
}

TEST(Digest, RefusesBytesThatAreNoSavedDigest) {
  Digest original;
  original.addBytes(std::string(3000, 'x').data(), 3000);
  std::string saved;
  original.save(saved);
  const std::uint64_t value = original.value();
  const auto loads_with = [&](std::size_t place, char byte) {
    std::string bad = saved;
    bad[place] = byte;
    return original.load(bad);
  };
  EXPECT_FALSE(original.load(saved.substr(1)));
  EXPECT_FALSE(loads_with(329, 2)) << "more than 256 bytes in the buffer";
  EXPECT_FALSE(loads_with(328, 0)) << "3000 bytes leave some in the buffer";
  EXPECT_FALSE(loads_with(332, 16)) << "a block has 16 stripes";
  EXPECT_EQ(original.value(), value);
}

TEST(Digest, DistinguishesNumbersThatDifferInOneBit) {
  Digest one, other;
  one.add(1.0);
  other.add(1.0 + 0x1p-52);
  EXPECT_NE(one.value(), other.value());
}

}  // namespace
}  // namespace robosim
