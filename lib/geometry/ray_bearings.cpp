#include "geometry/ray_bearings.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector_clones.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr auto kPi = static_cast<float>(M_PI);
/// More than what bearings below are wrong by [rad].
constexpr float kSlack_rad = 5e-4F;

/// Rounding may turn a ray by as much.
constexpr double kRounding_rad = 1e-9;

/// Bearing of (x, y) from the x axis, within 1e-4 rad: the odd polynomial of degree 7 that is nearest to the arctangent
/// between 0 and 1 (Remez' algorithm), turned and mirrored to where (x, y) is. Without branches, so that a loop becomes
/// vector instructions.
[[gnu::always_inline]] inline float roughBearing(float y, float x) {
  const float along = std::abs(x);
  const float aside = std::abs(y);
  const float more = along > aside ? along : aside;
  const float less = along > aside ? aside : along;
  const float a = less / (more > 1e-30F ? more : 1e-30F);
  const float s = a * a;
  const float flat = a * (0.99921381F + s * (-0.32117497F + s * (0.14626446F + s * -0.03898651F)));
  const float steep = along > aside ? flat : kPi / 2 - flat;
  const float turned = x < 0 ? kPi - steep : steep;
  return y < 0 ? -turned : turned;
}

/// An upper bound of the arcsine of a number from 0 to 1; exact at both.
[[gnu::always_inline]] inline float arcsineAtMost(float s) { return s + (kPi / 2 - 1) * s * s * s; }

/// The bins of the first and the last bearing of each candidate, counted from straight behind, a bin being 1 wide; and
/// how near it comes.
ROBOSIM_VECTOR_CLONES
void findBins(const RoughPlace& place, float ahead_x, float ahead_y, const Candidates::Pack& solids, std::size_t lanes,
              float bins, std::int32_t* __restrict first, std::int32_t* __restrict last, float* __restrict nearest_m) {
  const float per_rad = bins / (2 * kPi);
  for (std::size_t k = 0; k < lanes; ++k) {
    const float x = solids.x[k] - place.x;
    const float y = solids.y[k] - place.y;
    const float ux = solids.axis_x[k];
    const float uy = solids.axis_y[k];
    const float half_length = solids.half_length_m[k];
    const float half_width = solids.half_width_m[k];
    // The box's corners, as seen along the line to its centre: a circle's all lie there.
    const float p = x * ux + y * uy;
    const float q = x * uy - y * ux;
    const float far2 = x * x + y * y;
    const float along_a = half_length * p;
    const float along_b = half_width * q;
    const float aside_a = half_length * q;
    const float aside_b = half_width * p;
    const float corner_1 = roughBearing(aside_a + aside_b, far2 + along_a - along_b);
    const float corner_2 = roughBearing(aside_a - aside_b, far2 + along_a + along_b);
    const float corner_3 = roughBearing(-aside_a + aside_b, far2 - along_a - along_b);
    const float corner_4 = roughBearing(-aside_a - aside_b, far2 - along_a + along_b);
    const float right_12 = corner_1 < corner_2 ? corner_1 : corner_2;
    const float right_34 = corner_3 < corner_4 ? corner_3 : corner_4;
    const float left_12 = corner_1 < corner_2 ? corner_2 : corner_1;
    const float left_34 = corner_3 < corner_4 ? corner_4 : corner_3;
    // And by how much it is rounder than its box, as seen from where that is nearest.
    const float beyond_p = std::abs(p) - half_length;
    const float beyond_q = std::abs(q) - half_width;
    const float out_p = beyond_p > 0 ? beyond_p : 0;
    const float out_q = beyond_q > 0 ? beyond_q : 0;
    const float nearest = std::sqrt(out_p * out_p + out_q * out_q);
    const float round = solids.round_m[k] + place.lost_m;
    const bool is_near = !(nearest > round);
    const float wider = arcsineAtMost(is_near ? 1 : round / nearest) + kSlack_rad;

    const float center = roughBearing(ahead_x * y - ahead_y * x, ahead_x * x + ahead_y * y);
    const float right = center + (right_12 < right_34 ? right_12 : right_34) - wider;
    const float left = center + (left_12 < left_34 ? left_34 : left_12) + wider;
    // The last: where no solid is, in the rest of the last vector, nothing is a number that could be a bin.
    const bool is_all_round = is_near | !(right > -kPi) | !(left < kPi) | !(right <= left);
    first[k] = static_cast<std::int32_t>(is_all_round ? 0 : (right + kPi) * per_rad);
    last[k] = static_cast<std::int32_t>(is_all_round ? bins : (left + kPi) * per_rad);
    nearest_m[k] = nearest - round;
  }
}

}  // namespace

RayBearings::RayBearings(std::span<const Ray> rays) {
  if (rays.empty()) return;
  // From one ray to the next, counter-clockwise.
  std::vector<double> turned_rad{0};
  for (std::size_t i = 1; i < rays.size(); ++i) {
    const auto& from = rays[i - 1].direction;
    const auto& to = rays[i].direction;
    const double turn_rad = std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
    if (turn_rad < -kRounding_rad) return;
    turned_rad.push_back(turned_rad.back() + std::max(0.0, turn_rad));
  }
  const double field_rad = turned_rad.back();
  if (field_rad > 2 * M_PI + kRounding_rad) return;
  go_round_ = true;
  const double cos = std::cos(field_rad / 2);
  const double sin = std::sin(field_rad / 2);
  const auto& first = rays.front().direction;
  ahead_ = {cos * first.x - sin * first.y, sin * first.x + cos * first.y};

  for (std::size_t bin = 0; bin <= kBins; ++bin) {
    const double from_rad = (static_cast<double>(bin) / kBins * 2 - 1) * M_PI;
    const auto ray = std::lower_bound(turned_rad.begin(), turned_rad.end(), from_rad + field_rad / 2);
    first_.push_back(static_cast<std::uint32_t>(ray - turned_rad.begin()));
  }
  first_.front() = 0;
  first_.back() = static_cast<std::uint32_t>(rays.size());
}

void RayBearings::find(const RoughPlace& place, const TPoint2D& ahead, const Candidates& candidates,
                       Ranges& ranges) const {
  std::array<std::int32_t, Candidates::Pack::kMost> first, last;
  std::array<float, Candidates::Pack::kMost> nearest_m;
  findBins(place, static_cast<float>(ahead.x), static_cast<float>(ahead.y), candidates.pack, candidates.lanes(),
           float{kBins}, first.data(), last.data(), nearest_m.data());
  // A bin's last ray is before the next bin's first.
  constexpr auto kLast = static_cast<std::int32_t>(kBins) - 1;
  for (std::size_t k = 0; k < candidates.pack.count; ++k) {
    ranges[k] = {first_[static_cast<std::size_t>(std::min(first[k], kLast))],
                 first_[static_cast<std::size_t>(std::min(last[k], kLast) + 1)], nearest_m[k]};
  }
}

}  // namespace robosim
