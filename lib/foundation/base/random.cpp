#include "base/random.h"

#include <cmath>

#include <Random123/philox.h>

#include "base/portable_math.h"

namespace robosim {

Rng::Rng(std::uint64_t seed, RandomPurpose purpose, std::uint32_t robot, std::uint32_t item, std::uint64_t step)
    : seed_(seed),
      // The counter's words: robot, purpose and item, step, and number of blocks drawn.
      counter_{robot, (static_cast<std::uint32_t>(purpose) << 24) ^ item, static_cast<std::uint32_t>(step), 0} {}

void Rng::drawBlock() {
  const r123::Philox4x32 philox;
  const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
  const auto block = philox(counter, key);
  for (unsigned i = 0; i < 4; ++i) block_[i] = block[i];
  ++counter_[3];
  left_ = 4;
}

double Rng::uniform(double from, double to) { return from + (to - from) * uniform(); }

double Rng::gaussian() {
  // Box & Muller (1958). The second number of each pair is discarded: keeping it would make the results depend on
  // earlier draws.
  const double radius = std::sqrt(-2 * portable::log(1 - uniform()));
  return radius * portable::cos(2 * M_PI * uniform());
}

std::uint32_t Rng::below(std::uint32_t n) {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>((*this)()) * n) >> 32);
}

}  // namespace robosim
