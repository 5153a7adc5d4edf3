#include "base/random_blocks.h"

#include "base/vector_width.h"

namespace robosim {
namespace {

/// Philox 4×32-10 (base/random.h) of the counters (c0, c1, c2, i). Every number is 64 bits wide, because products are.
[[gnu::always_inline]] inline void philoxBlocks(std::uint32_t c0, std::uint32_t c1, std::uint32_t c2,
                                                std::uint32_t key_0, std::uint32_t key_1, std::size_t count,
                                                std::uint32_t* __restrict to_0, std::uint32_t* __restrict to_1,
                                                std::uint32_t* __restrict to_2, std::uint32_t* __restrict to_3) {
  constexpr std::uint64_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57;
  constexpr std::uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
  constexpr std::uint64_t kLow = 0xffffffff;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t a = c0, b = c1, c = c2, d = i & kLow;
    std::uint64_t k0 = key_0, k1 = key_1;
#pragma GCC unroll 10
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t product_0 = kMultiplier0 * (a & kLow);
      const std::uint64_t product_1 = kMultiplier1 * (c & kLow);
      a = (product_1 >> 32) ^ b ^ k0;
      b = product_1 & kLow;
      c = (product_0 >> 32) ^ d ^ k1;
      d = product_0 & kLow;
      k0 = (k0 + kWeyl0) & kLow;
      k1 = (k1 + kWeyl1) & kLow;
    }
    // Rng returns the numbers of a block from the last to the first.
    to_0[i] = static_cast<std::uint32_t>(d);
    to_1[i] = static_cast<std::uint32_t>(c);
    to_2[i] = static_cast<std::uint32_t>(b);
    to_3[i] = static_cast<std::uint32_t>(a);
  }
}

}  // namespace

void RandomBlocks::draw(std::uint64_t seed, RandomPurpose purpose, std::uint32_t robot, std::uint32_t item,
                        std::uint64_t step, std::size_t count) {
  for (auto& of_items : words) of_items.resize(count);
  withVectors<philoxBlocks>(robot, (static_cast<std::uint32_t>(purpose) << 24) ^ item, static_cast<std::uint32_t>(step),
                            static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), count,
                            words[0].data(), words[1].data(), words[2].data(), words[3].data());
}

}  // namespace robosim
