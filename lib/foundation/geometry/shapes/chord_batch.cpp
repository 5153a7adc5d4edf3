#include "geometry/shapes/chord_batch.h"

#include <algorithm>

namespace robosim {
namespace {

constexpr std::size_t kTogether = 4;  ///< angles of a vector

}  // namespace

void ChordBatch::compute() {
  if (size_ + turning_ <= kTogether) return computeFew();
  portable::sincos({direction_rad_.data(), size_}, sin_.data(), cos_.data());
  if (turning_ == 0) return;
  std::array<double, kCapacity> sin_of_half, cos_of_half;
  portable::sincos({half_turn_rad_.data(), turning_}, sin_of_half.data(), cos_of_half.data());
  for (std::size_t k = 0; k < turning_; ++k) per_arc_[arc_of_turn_[k]] = sin_of_half[k] / half_turn_rad_[k];
}

// Those of a world with one or two robots, whose angles fit into one vector.
void ChordBatch::computeFew() {
  std::array<double, kTogether> angles_rad{}, sines, cosines;
  std::copy_n(direction_rad_.data(), size_, angles_rad.data());
  std::copy_n(half_turn_rad_.data(), turning_, angles_rad.data() + size_);
  portable::sincos(angles_rad, sines.data(), cosines.data());
  std::copy_n(sines.data(), size_, sin_.data());
  std::copy_n(cosines.data(), size_, cos_.data());
  for (std::size_t k = 0; k < turning_; ++k) per_arc_[arc_of_turn_[k]] = sines[size_ + k] / half_turn_rad_[k];
}

}  // namespace robosim
