#pragma once
#include "rendering/ground_view.h"

namespace robosim {

/// A GroundView with margins for a title above and a legend below. Its longer side has kLongSide_px.
class PlanView : public GroundView {
 public:
  /// @param area to be shown; a side of length 0 is shown as a narrow strip
  explicit PlanView(const Bounds2D& area);

  static constexpr int kLongSide_px = 1200;
  static constexpr int kShortSideMin_px = 440;  ///< minimum for the legend of a long, narrow world
  static constexpr int kSideMargin_px = 24;
  static constexpr int kTopMargin_px = 44;
  static constexpr int kBottomMargin_px = 56;
};

}  // namespace robosim
