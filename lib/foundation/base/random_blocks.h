#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/random.h"

namespace robosim {

/// Random numbers of many equal items, computed together with vectors. words[k][i] is the k-th of the four numbers of
/// item i; the numbers of item i are the (4i + 1)-th to (4i + 4)-th of an Rng with the same arguments.
struct RandomBlocks {
  std::array<std::vector<std::uint32_t>, 4> words;

  void draw(std::uint64_t seed, RandomPurpose purpose, std::uint32_t robot, std::uint32_t item, std::uint64_t step,
            std::size_t count);
};

}  // namespace robosim
