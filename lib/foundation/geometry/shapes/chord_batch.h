#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "base/portable_math.h"

namespace robosim {

/// Chords of many arcs of constant curvature, computed together in vectors. Bit for bit those that portable::sincos()
/// gives one by one.
class ChordBatch {
 public:
  static constexpr std::size_t kCapacity = 64;

  /// Chord of an arc from its start to its end.
  struct Chord {
    double per_arc = 1;          ///< its length by that of the arc
    portable::SinCos direction;  ///< from the frame's x axis
  };

  std::size_t size() const { return size_; }
  /// @param start_rad direction in which the arc starts @param half_turn_rad half of the angle by which it turns
  /// @pre size() < kCapacity
  void add(double start_rad, double half_turn_rad) {
    direction_rad_[size_] = start_rad + half_turn_rad;
    per_arc_[size_] = 1;
    half_turn_rad_[turning_] = half_turn_rad;
    arc_of_turn_[turning_] = size_++;
    turning_ += half_turn_rad != 0 ? 1 : 0;
  }
  void compute();
  /// @pre compute() since the last add()
  Chord operator[](std::size_t i) const { return {per_arc_[i], {sin_[i], cos_[i]}}; }

 private:
  void computeFew();

  std::size_t size_ = 0;
  std::array<double, kCapacity> direction_rad_, per_arc_, sin_, cos_;
  // Of the arcs that turn.
  std::size_t turning_ = 0;
  std::array<double, kCapacity> half_turn_rad_;
  std::array<std::size_t, kCapacity> arc_of_turn_;
};

}  // namespace robosim
