#pragma once
#include <cstdint>

#include "base/random.h"

namespace robosim {

/// Gaussian random numbers by the ziggurat method (Marsaglia & Tsang, "The ziggurat method for generating random
/// variables", Journal of Statistical Software 5(8), 2000), with 128 layers. The layer and the position in it are taken
/// from different bits of a number (Doornik, "An improved ziggurat method", 2005). The results are the same on every
/// processor.
class Ziggurat {
 public:
  static const Ziggurat& instance();

  /// A number of mean 0 and standard deviation 1.
  /// @param word uniform random bits, which suffice in 97.5 % of all cases
  /// @param more returns an Rng for the other cases; independent of the word
  template <typename MakeRng>
  double gaussian(std::uint32_t word, const MakeRng& more) const {
    const std::uint32_t layer = word & (kLayers - 1);
    // The upper 25 bits, with sign.
    const double position = static_cast<double>(static_cast<std::int32_t>(word) >> 7) * 0x1p-24;
    if (position < ratio_[layer] && -position < ratio_[layer]) [[likely]]
      return position * edge_[layer];
    Rng rng = more();
    return beyond(layer, position, rng);
  }

 private:
  static constexpr std::uint32_t kLayers = 128;

  Ziggurat();
  double beyond(std::uint32_t layer, double position, Rng& rng) const;

  double edge_[kLayers + 1];    ///< outer edge of each layer, from the base outwards in; the last is 0
  double height_[kLayers + 1];  ///< exp(-edge² / 2)
  double ratio_[kLayers];       ///< edge of the layer above, over that of the layer
};

}  // namespace robosim
