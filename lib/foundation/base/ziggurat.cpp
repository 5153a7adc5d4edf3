#include "base/ziggurat.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

/// Begin of the tail, and area of each layer, for 128 layers (Marsaglia & Tsang).
constexpr double kTail = 3.442619855899;
constexpr double kArea = 9.91256303526217e-3;

}  // namespace

const Ziggurat& Ziggurat::instance() {
  static const Ziggurat ziggurat;
  return ziggurat;
}

Ziggurat::Ziggurat() {
  const auto density = [](double x) { return portable::exp(-x * x / 2); };
  edge_[0] = kArea / density(kTail);
  edge_[1] = kTail;
  for (std::uint32_t i = 2; i < kLayers; ++i) {
    edge_[i] = std::sqrt(-2 * portable::log(kArea / edge_[i - 1] + density(edge_[i - 1])));
  }
  edge_[kLayers] = 0;
  for (std::uint32_t i = 0; i <= kLayers; ++i) height_[i] = density(edge_[i]);
  for (std::uint32_t i = 0; i < kLayers; ++i) ratio_[i] = edge_[i + 1] / edge_[i];
}

double Ziggurat::beyond(std::uint32_t layer, double position, Rng& rng) const {
  while (true) {
    const double x = position * edge_[layer];
    if (std::abs(position) < ratio_[layer]) return x;
    if (layer == 0) {
      double out = 0, up = 0;
      do {
        out = -portable::log(1 - rng.uniform()) / kTail;
        up = -portable::log(1 - rng.uniform());
      } while (2 * up < out * out);
      return std::copysign(kTail + out, position);
    }
    const double under = height_[layer] + rng.uniform() * (height_[layer + 1] - height_[layer]);
    if (under < portable::exp(-x * x / 2)) return x;
    layer = rng() & (kLayers - 1);
    position = rng.uniform(-1, 1);
  }
}

}  // namespace robosim
