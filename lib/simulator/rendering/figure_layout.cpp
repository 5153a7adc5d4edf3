#include "rendering/figure_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/core/format.h>

#include "base/error_list.h"
#include "rendering/drawn_text.h"
#include "rendering/font_lookup.h"

namespace robosim {
namespace {

constexpr double kTitlePerText = 4.0 / 3;

struct Margins {
  double left, right, top, bottom;  ///< [px]
};

double longest(TextRuler& ruler, double text_px, const std::vector<std::pair<double, std::string>>& labels) {
  double width_px = 0;
  for (const auto& [at_m, label] : labels) width_px = std::max(width_px, ruler.width(label, text_px));
  return width_px;
}

/// Distance of ticks [m]: that of the grid, or as much more as their numbers require.
double tickStep(TextRuler& ruler, double text_px, const Bounds2D& area, const GroundView& view) {
  double step_m = gridStep(view);
  const double label_px = std::max(longest(ruler, text_px, ticks(area.x_min, area.x_max, step_m)),
                                   longest(ruler, text_px, ticks(area.y_min, area.y_max, step_m)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (step_m * view.pixelsPerMetre() >= label_px + 1.3 * text_px) break;
    step_m *= factor;
  }
  return step_m;
}

/// Fits an area between margins. @param plot is set to its place
GroundView fitted(const Bounds2D& area, int width_px, const Margins& margins, Bounds2D& plot) {
  // Avoids an infinite scale for an area without extent.
  const double longer_m = std::max({area.x_max - area.x_min, area.y_max - area.y_min, 1e-3});
  const double width_m = std::max(area.x_max - area.x_min, longer_m / 1000);
  const double height_m = std::max(area.y_max - area.y_min, longer_m / 1000);
  const double room_px = width_px - margins.left - margins.right;
  const double height_max_px = M_SQRT2 * width_px - margins.top - margins.bottom;
  const double px_per_m = std::min(room_px / width_m, height_max_px / height_m);
  const double left = margins.left + (room_px - width_m * px_per_m) / 2;
  plot = {left, left + width_m * px_per_m, margins.top, margins.top + height_m * px_per_m};
  const int height_px = static_cast<int>(std::ceil(plot.y_max + margins.bottom));
  const mrpt::math::TPoint2D center(area.x_min + ((width_px - 1) / 2.0 - plot.x_min) / px_per_m,
                                    area.y_max + (plot.y_min - (height_px - 1) / 2.0) / px_per_m);
  return {width_px, height_px, center, px_per_m};
}

}  // namespace

std::vector<std::pair<double, std::string>> ticks(double from_m, double to_m, double step_m) {
  std::vector<std::pair<double, std::string>> found;
  const auto last = static_cast<long>(std::floor(to_m / step_m + 1e-9));
  for (auto i = static_cast<long>(std::ceil(from_m / step_m - 1e-9)); i <= last; ++i) {
    found.emplace_back(static_cast<double>(i) * step_m, mrpt::format("%.6g", static_cast<double>(i) * step_m));
  }
  return found;
}

double tickLabelY(double text_px) { return kTick_px + 1.35 * text_px; }
double axisLabelY(double text_px) { return kTick_px + 3.2 * text_px; }
double headerY(double text_px) { return 2.1 * text_px; }

FigureLayout computeLayout(const World& world, const DrawnRun& run, const FigurePage& page) {
  TextRuler ruler;
  const int width_px = static_cast<int>(std::lround(page.width_mm / kMmPerInch * kPixelsPerInch));
  const double px_per_mm = width_px / page.width_mm;
  const double text_px = page.font_pt / kPointsPerInch * kMmPerInch * px_per_mm * kCapitalPerEm;
  const double title_px = kTitlePerText * text_px;
  const auto width_of = [&](const std::string& text) { return ruler.width(text, text_px); };
  const Bounds2D area = areaOf(world, run);
  const std::string& title = run.title.empty() ? world.name : run.title;

  const double edge_px = text_px;
  const double header_px = edge_px + title_px;  // middle of the title
  Margins margins{edge_px + kTick_px + kTickGap_px + width_of("y [m]"), 2 * edge_px, header_px + headerY(text_px), 0};
  Legend legend(makeLegend(run), text_px, width_px - margins.left - margins.right, width_of);
  const double legend_below_px = axisLabelY(text_px) + 2.6 * text_px;
  margins.bottom = legend.lines() == 0
                       ? axisLabelY(text_px) + text_px + edge_px
                       : legend_below_px + static_cast<double>(legend.lines() - 1) * legend.linePitch() + 2 * edge_px;
  Bounds2D plot;
  GroundView view;
  double tick_step_m = 1;
  bool has_scale_line = false;
  // Margins depend on the scale by the numbers at the ticks, and the scale on the margins, which therefore only grow.
  for (int round = 0; round < 5; ++round) {
    if (width_px - margins.left - margins.right < 8 * text_px ||
        M_SQRT2 * width_px - margins.top - margins.bottom < 8 * text_px) {
      throw ConfigError(mrpt::format(
          "a figure %g mm wide has no room for text of %g pt beside its plan; make it wider or the text smaller",
          page.width_mm, page.font_pt));
    }
    view = fitted(area, width_px, margins, plot);
    tick_step_m = tickStep(ruler, text_px, area, view);
    const double left =
        edge_px + kTick_px + kTickGap_px + longest(ruler, text_px, ticks(area.y_min, area.y_max, tick_step_m));
    const auto x_labels = ticks(area.x_min, area.x_max, tick_step_m);
    const double right = edge_px + longest(ruler, text_px, x_labels) / 2;
    const double title_room_px = width_px - margins.left - margins.right - 2 * text_px;
    const bool needs_line =
        !has_scale_line && ruler.width(title, title_px) + scaleWidth(view, text_px, width_of) > title_room_px;
    if (left <= margins.left && right <= margins.right && !needs_line) break;
    margins.left = std::max(margins.left, left);
    margins.right = std::max(margins.right, right);
    if (needs_line) {
      has_scale_line = true;
      margins.top += 2.4 * text_px;
    }
  }
  const double right = width_px - margins.right;
  return {view,
          text_px,
          title_px,
          ruler.shortened(title, title_px, right - margins.left),
          {margins.left, header_px},
          {right - scaleWidth(view, text_px, width_of), header_px + (has_scale_line ? 2.4 * text_px : 0)},
          plot,
          tick_step_m,
          right,
          std::move(legend),
          plot.y_max + legend_below_px};
}

}  // namespace robosim
