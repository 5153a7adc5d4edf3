#pragma once
#include <string>

#include "rendering/drawn_run.h"
#include "rendering/picture_format.h"
#include "rendering/plan_view.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Margins for axes, a title above and a legend below; as wide as a page of A4 without its margins (18 cm).
inline constexpr PageLayout kFigureLayout{680, 440, 52, 16, 36, 78};

/// The view of the area that a figure covers.
PlanView figureView(const World&, const DrawnRun&);

/// Draws a run for publication: its plan, as planPicture() does, at the size of a page of paper, with axes in metres, a
/// scale bar, the events, and a legend. A PNG picture has two pixels per pixel of the view.
/// @return the file, whose bytes depend only on the arguments and the installed font
std::string runFigure(PictureFormat, const World&, const Fleet&, const DrawnRun&);

}  // namespace robosim
