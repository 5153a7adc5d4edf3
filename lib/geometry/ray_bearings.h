#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/candidates.h"
#include "geometry/ray.h"

namespace robosim {

/// The bearings of rays that go round in one sense, a laser's for one: the solids that a ray may meet are those whose
/// bearing is the ray's, and a solid of some bearing concerns a few rays side by side. So a solid costs as much as it
/// is wide, rather than a look for each ray.
class RayBearings {
 public:
  /// Rays from `begin` up to `end`, which can meet a solid no nearer than at `nearest_m`.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    float nearest_m = 0;
  };
  using Ranges = std::array<Range, Candidates::Pack::kMost>;

  RayBearings() = default;
  explicit RayBearings(std::span<const Ray> rays);

  /// Whether the rays go round counter-clockwise, once at most; if not, the rest is of no use.
  bool goRound() const { return go_round_; }
  /// The direction in the middle of all rays, in their frame: a unit vector.
  const mrpt::math::TPoint2D& ahead() const { return ahead_; }

  /// Which rays may meet each candidate; all rays for one that is near, or straight behind.
  /// @param place that the rays start near; `lost_m` has room for how far from it they do
  /// @param ahead ahead() where the rays are now
  void find(const RoughPlace& place, const mrpt::math::TPoint2D& ahead, const Candidates& candidates,
            Ranges& ranges) const;

 private:
  /// Of equal width, from straight behind all round: half a degree each.
  static constexpr std::size_t kBins = 720;

  bool go_round_ = false;
  mrpt::math::TPoint2D ahead_;
  std::vector<std::uint32_t> first_;  ///< by bin, and the end: the first ray that is not before the bin
};

}  // namespace robosim
