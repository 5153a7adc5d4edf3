#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry/casting/items_of_four.h"
#include "geometry/index/culling.h"

/// Conservative culling by bearing in single precision: finds the interval of bearings at which a solid lies, without
/// false negatives. Branch-free and always inlined, so that the loops over solids are vectorised.
namespace robosim {

/// Solids of a scene that beams of a batch may hit.
struct Candidates {
  static constexpr std::size_t kCapacity = 32;

  std::array<const GridItem*, kCapacity + 3> item;  ///< those from `count` on have no effect
  std::array<std::uint32_t, kCapacity> body;
  std::size_t count = 0;

  void add(const GridItem& solid, std::uint32_t number) {
    item[count] = &solid;
    body[count++] = number;
  }

  /// Branch-free, because whether a solid is a candidate is unpredictable.
  void addIf(bool condition, const GridItem& solid, std::uint32_t number) {
    item[count] = &solid;
    body[count] = number;
    count += condition ? 1 : 0;
  }
  bool isFull() const { return count == kCapacity; }
  /// Sets the next three items, for code that reads four at a time. @pre not empty
  void pad() { item[count] = item[count + 1] = item[count + 2] = item[0]; }
};

/// Bins of equal width over a full turn from bearing -π: 0.5° each.
constexpr std::size_t kBearingBins = 720;

/// Frame in which bearings are measured, and their margins.
struct CullFrame {
  double x, y;               ///< origin, world frame [m]
  float x_axis_x, x_axis_y;  ///< direction of bearing 0, world frame
  float spread_m;            ///< farthest origin of a beam from the frame's origin
  float half_width_rad;      ///< of the widest beam
  float reach_m;             ///< distance beyond which no solid can change the result
};

/// Candidates in single precision relative to the origin of a CullFrame, so that loops over solids are vectorised, and
/// the bins of their bearings. Entries beyond `count` are zero or outdated, and unused.
struct alignas(64) BearingArrays {
  float x[Candidates::kCapacity], y[Candidates::kCapacity], axis_x[Candidates::kCapacity],
      axis_y[Candidates::kCapacity], half_length[Candidates::kCapacity], half_width[Candidates::kCapacity];
  std::int32_t first[Candidates::kCapacity], last[Candidates::kCapacity];  ///< bins; `last` may lie in a second turn
  float nearest[Candidates::kCapacity];                                    ///< lower bound of the distance [m]
  std::int32_t is_far[Candidates::kCapacity];  ///< -1 if the solid is too far to change the result, otherwise 0
};

/// Sets of candidates: bit k for candidate k.
struct CandidatesByShape {
  std::uint32_t circles = 0, boxes = 0;
};

constexpr auto kFloatPi = static_cast<float>(M_PI);
/// Exceeds the error of the bearings below [rad].
constexpr float kBearingSlack_rad = 5e-4F;

/// Bearing of (x, y) from the x axis, within 1e-4 rad: the minimax odd polynomial of degree 7 for the arctangent on [0,
/// 1] (Remez algorithm), extended by symmetry. Branch-free, so that loops are vectorised.
[[gnu::always_inline]] inline float approximateBearing(float y, float x) {
  const float along = std::abs(x);
  const float aside = std::abs(y);
  const float more = along > aside ? along : aside;
  const float less = (along + aside) - more;  // not a selection, of which g++ would compute both branches
  const float a = less / (more + 1e-30F);
  const float s = a * a;
  const float flat = a * (0.99921381F + s * (-0.32117497F + s * (0.14626446F + s * -0.03898651F)));
  const float steep = along > aside ? flat : kFloatPi / 2 - flat;
  const float turned = x < 0 ? kFloatPi - steep : steep;
  return y < 0 ? -turned : turned;
}

/// An upper bound of the arcsine of a number from 0 to 1; exact at both.
[[gnu::always_inline]] inline float arcsineUpperBound(float s) { return s + (kFloatPi / 2 - 1) * s * s * s; }

/// Converts the candidates to single precision, and selects those at a height by shape. Four at a time: their items are
/// transposed in registers.
/// @pre candidates.pad()
/// @tparam kDisc whether findBins() computes covering discs, which have no axis
template <bool kDisc>
[[gnu::always_inline]] inline CandidatesByShape gather(const Candidates& candidates, const CullFrame& frame, double z_m,
                                                       BearingArrays& to) {
  CandidatesByShape found;
  for (std::size_t k = 0; k < candidates.count; k += 4) {
    const auto* const item = &candidates.item[k];
    const ItemsOfFour items(*item[0], *item[1], *item[2], *item[3]);
    storeFloats(items.x - frame.x, to.x + k);
    storeFloats(items.y - frame.y, to.y + k);
    if constexpr (!kDisc) {
      storeFloats(items.axis_x, to.axis_x + k);
      storeFloats(items.axis_y, to.axis_y + k);
    }
    storeFloats(items.half_length, to.half_length + k);
    storeFloats(items.half_width, to.half_width + k);
    const std::uint32_t at_height = signsOf((items.z_min <= z_m) & (items.z_max >= z_m)) << k;
    const std::uint32_t circles = signsOf(items.half_width == 0.0) << k;
    found.circles |= at_height & circles;
    found.boxes |= at_height & ~circles;
  }
  const std::uint32_t all = static_cast<std::uint32_t>((std::uint64_t{1} << candidates.count) - 1);
  return {found.circles & all, found.boxes & all};
}

/// Computes the interval of bearings of each candidate, as bins: of its outline, or of its covering disc, which is
/// cheaper.
/// @return set of the candidates that are too far to change the result; undefined beyond `count`
template <bool kDisc>
[[gnu::always_inline]] inline std::uint32_t findBins(CullFrame frame, std::size_t count, BearingArrays& arrays) {
  std::int32_t* __restrict first = arrays.first;
  std::int32_t* __restrict last = arrays.last;
  float* __restrict nearest_m = arrays.nearest;
  std::int32_t* __restrict is_far = arrays.is_far;
  constexpr auto kError = static_cast<float>(kCullRelativeError);
  constexpr std::size_t kLanes = 16;  // of floats in the widest vectors
  constexpr float kPerRad = kBearingBins / (2 * kFloatPi);
  const std::size_t lanes = (count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t k = 0; k < lanes; ++k) {
    const float x = arrays.x[k];
    const float y = arrays.y[k];
    const float ux = arrays.axis_x[k];
    const float uy = arrays.axis_y[k];
    const float half_width = arrays.half_width[k];
    float half_length = arrays.half_length[k];
    float right = 0;
    float left = 0;
    float nearest = 0;
    float round = frame.spread_m;
    if constexpr (kDisc) {
      nearest = std::sqrt(x * x + y * y);
      round += std::sqrt(half_length * half_length + half_width * half_width);
      round += kError * (nearest + round);
    } else {
      // A circle is its centre, rounded by its radius.
      const float radius = half_width == 0 ? half_length : 0;
      half_length -= radius;
      round += radius;
      // The corners relative to the line to the centre. For a circle all lie on that line.
      const float p = x * ux + y * uy;
      const float q = x * uy - y * ux;
      const float far2 = x * x + y * y;
      const float along_a = half_length * p;
      const float along_b = half_width * q;
      const float aside_a = half_length * q;
      const float aside_b = half_width * p;
      const float corner_1 = approximateBearing(aside_a + aside_b, far2 + along_a - along_b);
      const float corner_2 = approximateBearing(aside_a - aside_b, far2 + along_a + along_b);
      const float corner_3 = approximateBearing(-aside_a + aside_b, far2 - along_a - along_b);
      const float corner_4 = approximateBearing(-aside_a - aside_b, far2 - along_a + along_b);
      const float right_12 = corner_1 < corner_2 ? corner_1 : corner_2;
      const float right_34 = corner_3 < corner_4 ? corner_3 : corner_4;
      const float left_12 = corner_1 < corner_2 ? corner_2 : corner_1;
      const float left_34 = corner_3 < corner_4 ? corner_4 : corner_3;
      right = right_12 < right_34 ? right_12 : right_34;
      left = left_12 < left_34 ? left_34 : left_12;
      const float beyond_p = std::abs(p) - half_length;
      const float beyond_q = std::abs(q) - half_width;
      const float out_p = beyond_p > 0 ? beyond_p : 0;
      const float out_q = beyond_q > 0 ? beyond_q : 0;
      nearest = std::sqrt(out_p * out_p + out_q * out_q);
      round += kError * (std::abs(p) + std::abs(q) + half_length + half_width + round);
    }
    // The additional angle of the radius, at the nearest point.
    const bool is_near = !(nearest > round);
    const float wider = arcsineUpperBound(is_near ? 1 : round / nearest) + frame.half_width_rad + kBearingSlack_rad;
    const float center =
        approximateBearing(frame.x_axis_x * y - frame.x_axis_y * x, frame.x_axis_x * x + frame.x_axis_y * y);
    right += center - wider;
    left += center + wider;
    const float turn = right < -kFloatPi ? 2 * kFloatPi : 0;
    // Also true for unused entries, whose values may not fit a bin.
    const bool is_all_round = is_near | !(left - right < 2 * kFloatPi);
    first[k] = static_cast<std::int32_t>(is_all_round ? 0 : (right + turn + kFloatPi) * kPerRad);
    last[k] = static_cast<std::int32_t>(is_all_round ? float{kBearingBins - 1} : (left + turn + kFloatPi) * kPerRad);
    nearest_m[k] = nearest - round;
    is_far[k] = nearest - round > frame.reach_m ? -1 : 0;  // false for NaN
  }
  std::uint32_t far = 0;
  for (std::size_t k = 0; k < lanes; k += 4) {
    Int32Quad is_far_of_four;
    std::memcpy(&is_far_of_four, is_far + k, sizeof is_far_of_four);
    far |= signsOf(is_far_of_four) << k;
  }
  return far;
}

}  // namespace robosim
