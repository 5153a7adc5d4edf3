#include "rendering/run_figure.h"

#include "rendering/run_painter.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// @param share of the text's width that is left of x
void write(Figure& figure, const std::string& text, double text_px, double x, double share, double y) {
  figure.text({x - share * figure.textWidth(text, text_px), y}, text, text_px, kInkColor);
}

/// Axes at the lower and left edge of an area, with ticks at round lengths.
void paintAxes(Figure& figure, const FigureLayout& layout, const Bounds2D& area) {
  const double left = layout.plot.x_min, low = layout.plot.y_max, text_px = layout.text_px;
  const double beside = left - kTick_px - kTickGap_px;
  figure.line({left, low}, {layout.plot.x_max, low}, 1, kInkColor);
  figure.line({left, low}, {left, layout.plot.y_min}, 1, kInkColor);
  for (const auto& [x_m, label] : ticks(area.x_min, area.x_max, layout.tick_step_m)) {
    const double x = figure.view().toPixel({x_m, area.y_min}).x;
    figure.line({x, low}, {x, low + kTick_px}, 1, kInkColor);
    write(figure, label, text_px, x, 0.5, low + tickLabelY(text_px));
  }
  for (const auto& [y_m, label] : ticks(area.y_min, area.y_max, layout.tick_step_m)) {
    const double y = figure.view().toPixel({area.x_min, y_m}).y;
    figure.line({left - kTick_px, y}, {left, y}, 1, kInkColor);
    write(figure, label, text_px, beside, 1, y);
  }
  write(figure, "x [m]", text_px, (left + layout.plot.x_max) / 2, 0.5, low + axisLabelY(text_px));
  write(figure, "y [m]", text_px, beside, 1, layout.plot.y_min - headerY(text_px));
}

}  // namespace

GroundView figureView(const World& world, const DrawnRun& run, const FigurePage& page) {
  return computeLayout(world, run, page).view;
}

std::string runFigure(PictureFormat format, const World& world, const Fleet& fleet, const DrawnRun& whole,
                      const FigurePage& page) {
  const DrawnRun run = reduced(world, whole, figureView(world, whole, page).pixelsPerMetre());
  const FigureLayout layout = computeLayout(world, run, page);
  const std::string& title = run.title.empty() ? world.name : run.title;
  Figure figure(layout.view, kWhite, {.format = format, .title = title, .png_scale = 2, .width_mm = page.width_mm});
  RunPainter painter(figure, world, fleet, run,
                     {.text_px = layout.text_px, .path_px = 1.6, .names_within = layout.plot});
  painter.paintGround();
  painter.paintRobots();
  painter.paintEvents();
  painter.paintNames();
  paintAxes(figure, layout, areaOf(world, run));
  figure.text(layout.title_at, layout.title, layout.title_px, kInkColor);
  drawScale(figure, layout.scale_at, layout.text_px);
  layout.legend.paint(figure, painter, layout.right, layout.legend_y);
  return figure.finish();
}

}  // namespace robosim
