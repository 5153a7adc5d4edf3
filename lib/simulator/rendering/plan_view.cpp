#include "rendering/plan_view.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

GroundView fitted(const Bounds2D& area, const PageLayout& layout) {
  const double margins_px[] = {layout.left_px + layout.right_px, layout.top_px + layout.bottom_px};
  // Avoids an infinite scale for an area without extent.
  const double longer_m = std::max({area.x_max - area.x_min, area.y_max - area.y_min, 1e-3});
  const double size_m[] = {std::max(area.x_max - area.x_min, longer_m / 1000),
                           std::max(area.y_max - area.y_min, longer_m / 1000)};
  const double px_per_m =
      std::min((layout.long_side_px - margins_px[0]) / size_m[0], (layout.long_side_px - margins_px[1]) / size_m[1]);
  const auto side_px = [&](int i) {
    return std::clamp(static_cast<int>(std::ceil(size_m[i] * px_per_m + margins_px[i])), layout.short_side_min_px,
                      layout.long_side_px);
  };
  // Where margins differ, the picture's centre is not the area's.
  const double right_m = (layout.right_px - layout.left_px) / 2 / px_per_m;
  const double lower_m = (layout.bottom_px - layout.top_px) / 2 / px_per_m;
  const mrpt::math::TPoint2D middle(area.x_min + size_m[0] / 2 + right_m, area.y_max - size_m[1] / 2 - lower_m);
  return {side_px(0), side_px(1), middle, px_per_m};
}

}  // namespace

PlanView::PlanView(const Bounds2D& area, const PageLayout& layout) : GroundView(fitted(area, layout)) {}

double roundLengthUpTo(double limit) {
  const double power = std::pow(10, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

}  // namespace robosim
