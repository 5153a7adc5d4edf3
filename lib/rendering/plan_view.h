#pragma once
#include "rendering/ground_view.h"

namespace robosim {

/// A picture of a piece of ground with margins for a title above and a legend below. Its longer side has kLongSide_px.
class PlanView : public GroundView {
 public:
  /// @param area what must be on the picture; a side of no length is shown as a narrow strip.
  explicit PlanView(const Bounds2D& area);

  static constexpr int kLongSide_px = 1200;
  static constexpr int kShortSideMin_px = 440;  ///< room for the legend of a world like a corridor
  static constexpr int kSideMargin_px = 24;
  static constexpr int kTopMargin_px = 44;
  static constexpr int kBottomMargin_px = 56;
};

}  // namespace robosim
