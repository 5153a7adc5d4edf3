#include "rendering/plan_view.h"

#include <algorithm>
#include <cmath>

namespace robosim {

PlanView::PlanView(const Bounds2D& area) : area_(area) {
  constexpr double kMargins_px[] = {2 * kSideMargin_px, kTopMargin_px + kBottomMargin_px};
  // A strip of no width, or a point, would have no scale.
  const double longer_m = std::max({area.x_max - area.x_min, area.y_max - area.y_min, 1e-3});
  const double size_m[] = {std::max(area.x_max - area.x_min, longer_m / 1000),
                           std::max(area.y_max - area.y_min, longer_m / 1000)};
  px_per_m_ = std::min((kLongSide_px - kMargins_px[0]) / size_m[0], (kLongSide_px - kMargins_px[1]) / size_m[1]);
  const auto side_px = [&](int i) {
    return std::clamp(static_cast<int>(std::ceil(size_m[i] * px_per_m_ + kMargins_px[i])), kShortSideMin_px,
                      kLongSide_px);
  };
  width_px_ = side_px(0);
  height_px_ = side_px(1);
  left_px_ = (width_px_ - size_m[0] * px_per_m_) / 2 - 0.5;
  top_px_ = kTopMargin_px + (height_px_ - kMargins_px[1] - size_m[1] * px_per_m_) / 2 - 0.5;
}

double roundLengthUpTo(double limit) {
  const double power = std::pow(10, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

}  // namespace robosim
