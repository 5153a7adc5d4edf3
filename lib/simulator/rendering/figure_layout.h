#pragma once
#include <string>
#include <vector>

#include "rendering/drawn_run.h"
#include "rendering/figure_page.h"
#include "rendering/ground_view.h"
#include "rendering/legend.h"

namespace robosim {

/// Positions of the parts of a figure; lengths and positions in pixels of the view, of about 1/96 inch. Title, scale
/// bar, axes with their numbers, and legend have disjoint places around the plan.
struct FigureLayout {
  GroundView view;
  double text_px, title_px;  ///< height of a capital
  std::string title;         ///< shortened if it does not fit
  mrpt::math::TPoint2D title_at, scale_at;
  Bounds2D plot;  ///< of the plan
  double tick_step_m;
  double right;  ///< end of the legend
  Legend legend;
  double legend_y;  ///< middle of its first line
};

/// @throws ConfigError when the text is too large for the page
FigureLayout computeLayout(const World&, const DrawnRun&, const FigurePage&);

/// @name Axes, below and to the left of the plan
///@{
inline constexpr double kTick_px = 5;
inline constexpr double kTickGap_px = 4;  ///< between a tick and its number
/// Numbers of the ticks within a range, each with its text.
std::vector<std::pair<double, std::string>> ticks(double from_m, double to_m, double step_m);
double tickLabelY(double text_px);  ///< middle of the numbers below the plan
double axisLabelY(double text_px);  ///< middle of "x [m]" below the plan
double headerY(double text_px);     ///< middle of "y [m]" above the plan
///@}

}  // namespace robosim
