#include "sensors/beam_echoes.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "base/quads.h"
#include "base/vector_width.h"

namespace robosim {
namespace {

/// Echoes of four beams, each a vector.
template <bool kPans>
struct FourEchoes {
  static_assert(sizeof(Echo) == sizeof(FloatQuad));
  FloatQuad row[4];

  /// Branch-free, because whether a hit is in range is unpredictable.
  [[gnu::always_inline]] FourEchoes(const BeamFields::Four& beams, const EchoRule& rule, const double* hits_m) {
    DoubleQuad hit_m;
    loadFour(hits_m, hit_m);
    const auto range_m = __builtin_convertvector(hit_m, FloatQuad);
    const FloatQuad range_min_m = inEachLane(rule.range_min_m);
    const FloatQuad at_m = range_m < inEachLane(rule.range_max_m) ? range_m : inEachLane(rule.no_echo_m);
    const auto out_m = __builtin_convertvector(at_m, DoubleQuad);
    const FloatQuad read_m = range_m < range_min_m ? range_min_m : at_m;
    DoubleQuad dx, dy, dz, x_m, y_m, z_m;
    loadFour(beams.dx, dx);
    loadFour(beams.dy, dy);
    loadFour(beams.dz, dz);
    loadFour(beams.x, x_m);
    loadFour(beams.y, y_m);
    loadFour(beams.z, z_m);
    if constexpr (kPans) {
      const DoubleQuad unpanned_dx = dx;
      dx = rule.cos * unpanned_dx - rule.sin * dy;
      dy = rule.sin * unpanned_dx + rule.cos * dy;
    }
    const auto x = __builtin_convertvector(x_m + dx * out_m, FloatQuad);
    const auto y = __builtin_convertvector(y_m + dy * out_m, FloatQuad);
    const auto z = __builtin_convertvector(z_m + dz * out_m, FloatQuad);
    const auto low_range_x = __builtin_shufflevector(read_m, x, 0, 4, 1, 5);
    const auto high_range_x = __builtin_shufflevector(read_m, x, 2, 6, 3, 7);
    const auto low_yz = __builtin_shufflevector(y, z, 0, 4, 1, 5);
    const auto high_yz = __builtin_shufflevector(y, z, 2, 6, 3, 7);
    row[0] = __builtin_shufflevector(low_range_x, low_yz, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(low_range_x, low_yz, 2, 3, 6, 7);
    row[2] = __builtin_shufflevector(high_range_x, high_yz, 0, 1, 4, 5);
    row[3] = __builtin_shufflevector(high_range_x, high_yz, 2, 3, 6, 7);
  }
};

/// @param order null for echoes in the order of the beams
template <bool kPans, bool kHasOrder>
[[gnu::always_inline]] inline void computeEchoes(const BeamFields::Four* beams, std::size_t count, const EchoRule* rule,
                                                 const double* hit_m, const std::uint32_t* order, Echo* echoes) {
  const EchoRule kept = *rule;
  const auto store = [&](std::size_t i, const FloatQuad& row) __attribute__((always_inline)) {
    std::memcpy(static_cast<void*>(echoes + (kHasOrder ? order[i] : i)), &row, sizeof row);
  };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4, ++beams) {
    const FourEchoes<kPans> four(*beams, kept, hit_m + i);
    for (std::size_t k = 0; k < 4; ++k) store(i + k, four.row[k]);
  }
  if (i == count) return;
  double last_m[4] = {};
  std::copy(hit_m + i, hit_m + count, last_m);
  const FourEchoes<kPans> four(*beams, kept, last_m);
  for (std::size_t k = i; k < count; ++k) store(k, four.row[k - i]);
}

template <bool kHasOrder>
void setEchoes(const BeamFields& beams, const EchoRule& rule, const double* hit_m, const std::uint32_t* order,
               Echo* echoes) {
  if (rule.pans()) {
    withVectors<computeEchoes<true, kHasOrder>>(beams.fours(), beams.size(), &rule, hit_m, order, echoes);
  } else {
    withVectors<computeEchoes<false, kHasOrder>>(beams.fours(), beams.size(), &rule, hit_m, order, echoes);
  }
}

}  // namespace

void BeamFields::add(const Ray& beam) {
  const std::size_t lane = size_++ % 4;
  Four& four = lane == 0 ? fours_.emplace_back() : fours_.back();
  four.x[lane] = beam.origin.x;
  four.y[lane] = beam.origin.y;
  four.z[lane] = beam.origin.z;
  // As a pan by the angle 0 turns them, which may change the sign of a zero: without a pan they are used as they are.
  four.dx[lane] = 1.0 * beam.direction.x - 0.0 * beam.direction.y;
  four.dy[lane] = 0.0 * beam.direction.x + 1.0 * beam.direction.y;
  four.dz[lane] = beam.direction.z;
}

EchoRule::EchoRule(const SensorInfo& info, const PlanarTransform& pan)
    : cos(pan.cos()),
      sin(pan.sin()),
      range_min_m(static_cast<float>(info.range_min_m)),
      range_max_m(static_cast<float>(info.range_max_m)),
      no_echo_m(static_cast<float>(info.no_echo_m)) {
  assert(range_min_m <= range_max_m);
}

void setEchoes(const BeamFields& beams, const EchoRule& rule, std::span<const double> hit_m, Echoes& echoes) {
  assert(hit_m.size() >= beams.size());
  setEchoes<false>(beams, rule, hit_m.data(), nullptr, echoes.data());
}

void setEchoes(const BeamFields& beams, const EchoRule& rule, std::span<const double> hit_m,
               std::span<const std::uint32_t> order, Echoes& echoes) {
  assert(hit_m.size() >= beams.size());
  setEchoes<true>(beams, rule, hit_m.data(), order.data(), echoes.data());
}

}  // namespace robosim
