#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid_index.h"
#include "geometry/ray_pairs.h"
#include "geometry/ray_walks.h"
#include "geometry/rough_rays.h"

namespace robosim {

/// Level rays that have nothing in common, cast together. With one ray alone a processor guesses at each cell whether
/// anything is met there and whether the ray ends, and often wrong; here all rays look what lies in their cells, all go
/// on to the next, and so forth, and nobody guesses. (Embree calls such rays a stream.)
class RayStream {
 public:
  static constexpr std::size_t kMost = RayWalks::kMost;
  /// What body() is for a ray that has met nothing: lower than any body, so that nothing at the range itself is kept.
  static constexpr std::int64_t kNothing = -1;

  /// Casts level rays, kMost at most, among the solids of an index. A tie goes to the lowest number. Of a ray that is
  /// not level the answer means nothing.
  /// @param except the number of a solid that is left out; one beyond all leaves out nothing
  void cast(std::span<const Ray> rays, const GridIndex& index, double range_m, std::uint32_t except);

  /// Distance [m] from the origin of ray `i` to what it met, or the range.
  double distance(std::size_t i) const { return walks_.reach_m[i]; }
  /// The number of what it met.
  std::int64_t body(std::size_t i) const { return body_[i]; }

 private:
  void listPassed();
  void meetPassed(const GridIndex& index, std::uint32_t except);
  void settle();

  RayWalks walks_;
  RoughRays rough_;
  std::array<double, kMost> z_m_{};
  std::array<std::int64_t, kMost> body_{};
  RoughRays::Passed passed_{};
  /// The same as a list: 8 times the ray's place among those that go on, and the solid's in its pack.
  std::array<std::uint32_t, 8 * kMost + 4> listed_{};
  std::size_t listed_count_ = 0;
  RayPairs pairs_;
};

}  // namespace robosim
