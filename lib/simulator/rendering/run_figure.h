#pragma once
#include <string>

#include "rendering/drawn_run.h"
#include "rendering/figure_layout.h"
#include "rendering/picture_format.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// The view of the area that a figure covers.
GroundView figureView(const World&, const DrawnRun&, const FigurePage& page = {});

/// Draws a run for publication: its plan, as planPicture() does, at a size on paper, with axes in metres, a scale bar,
/// ranges of sensors, the events, and a legend. No label covers another one; names without room are omitted. A PNG
/// picture has two pixels per pixel of the view, about 1/192 inch.
/// @return the file, whose bytes depend only on the arguments and the installed font
/// @throws ConfigError when the text is too large for the page
std::string runFigure(PictureFormat, const World&, const Fleet&, const DrawnRun&, const FigurePage& page = {});

}  // namespace robosim
