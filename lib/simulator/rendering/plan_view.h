#pragma once
#include "rendering/ground_view.h"

namespace robosim {

/// Size and margins of a page with a view from above, in pixels.
struct PageLayout {
  int long_side_px;
  int short_side_min_px;  ///< minimum for the legend of a long, narrow world
  double left_px, right_px, top_px, bottom_px;
};

/// Margins for a title above and a legend below.
inline constexpr PageLayout kPlanLayout{1200, 440, 24, 24, 44, 56};

/// A GroundView with margins. Its longer side has the layout's length.
class PlanView : public GroundView {
 public:
  /// @param area to be shown; a side of length 0 is shown as a narrow strip
  explicit PlanView(const Bounds2D& area, const PageLayout& layout = kPlanLayout);
};

}  // namespace robosim
