#include "rendering/run_figure.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <mrpt/core/format.h>

#include "rendering/run_painter.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kTick_px = 5;
constexpr double kLabelGap_px = 10;
constexpr double kText_px = 7.5;  ///< height of a capital
constexpr double kTitle_px = 10;
constexpr double kTitleY_px = 17;

/// Axes at the lower and left edge of an area, with ticks at round lengths.
class Axes {
 public:
  Axes(Figure& figure, const Bounds2D& area)
      : figure_(figure),
        area_(area),
        low_(figure.view().toPixel({area.x_min, area.y_min})),
        high_(figure.view().toPixel({area.x_max, area.y_max})),
        step_m_(gridStep(figure.view())) {
    double label_px = 0;
    const auto measure = [&](double, const std::string& label) {
      label_px = std::max(label_px, figure_.textWidth(label, kText_px));
    };
    forTicks(area_.x_min, area_.x_max, measure);
    for (const double factor : {2.0, 2.5, 2.0}) {
      if (step_m_ * figure_.view().pixelsPerMetre() >= label_px + kLabelGap_px) break;
      step_m_ *= factor;
    }
  }

  void paint() {
    figure_.line(low_, {high_.x, low_.y}, 1, kInkColor);
    figure_.line(low_, {low_.x, high_.y}, 1, kInkColor);
    forTicks(area_.x_min, area_.x_max, [&](double x_m, const std::string& label) {
      const double x = figure_.view().toPixel({x_m, area_.y_min}).x;
      figure_.line({x, low_.y}, {x, low_.y + kTick_px}, 1, kInkColor);
      write(label, x, 0.5, low_.y + kTick_px + 10);
    });
    forTicks(area_.y_min, area_.y_max, [&](double y_m, const std::string& label) {
      const double y = figure_.view().toPixel({area_.x_min, y_m}).y;
      figure_.line({low_.x - kTick_px, y}, {low_.x, y}, 1, kInkColor);
      write(label, low_.x - kTick_px - 4, 1, y);
    });
    write("x [m]", (low_.x + high_.x) / 2, 0.5, low_.y + kTick_px + 26);
    write("y [m]", low_.x - kTick_px - 4, 1, high_.y - 16);
  }

 private:
  template <typename Visit>
  void forTicks(double from_m, double to_m, const Visit& visit) const {
    const auto last = static_cast<long>(std::floor(to_m / step_m_ + 1e-9));
    for (auto i = static_cast<long>(std::ceil(from_m / step_m_ - 1e-9)); i <= last; ++i) {
      visit(static_cast<double>(i) * step_m_, mrpt::format("%.6g", static_cast<double>(i) * step_m_));
    }
  }

  /// @param share of the text's width that is left of x
  void write(const std::string& text, double x, double share, double y) {
    figure_.text({x - share * figure_.textWidth(text, kText_px), y}, text, kText_px, kInkColor);
  }

  Figure& figure_;
  const Bounds2D area_;
  const TPoint2D low_, high_;  ///< corners of the area [px]
  double step_m_;              ///< between ticks
};

/// A scale bar beside the title, which leaves the line below the axis to the legend.
void paintScale(Figure& figure) {
  const TPoint2D from(figure.view().width() - kFigureLayout.right_px - scaleWidth(figure, kText_px), kTitleY_px);
  drawScale(figure, from, kText_px);
}

void paintLegend(Figure& figure, RunPainter& painter, const DrawnRun& run) {
  Legend legend(figure, figure.view().width() - kFigureLayout.right_px, figure.view().height() - 16, kText_px);
  const std::pair<RunEvent::Kind, const char*> kinds[] = {{RunEvent::Kind::stall, "stall"},
                                                          {RunEvent::Kind::message, "message sent"},
                                                          {RunEvent::Kind::gold, "gold found"}};
  for (const auto& [kind, word] : kinds) {
    const auto is_of_kind = [kind = kind](const RunEvent& event) { return event.kind == kind; };
    if (std::none_of(run.events.begin(), run.events.end(), is_of_kind)) continue;
    const Color color = mix(kPageColor, kInkColor, 0.7f);
    legend.add(word, 14, [&, kind = kind](const TPoint2D& at) { painter.paintEvent(kind, at, color); });
  }
  paintPathLegend(legend, painter, figure);
}

}  // namespace

PlanView figureView(const World& world, const DrawnRun& run) { return PlanView(areaOf(world, run), kFigureLayout); }

std::string runFigure(PictureFormat format, const World& world, const Fleet& fleet, const DrawnRun& run) {
  const std::string& title = run.title.empty() ? world.name : run.title;
  Figure figure(figureView(world, run), kWhite, {.format = format, .title = title, .png_scale = 2});
  RunPainter painter(figure, world, fleet, run, {.text_px = kText_px, .path_px = 1.6});
  painter.paintGround();
  painter.paintRobots();
  painter.paintEvents();
  painter.paintNames();
  Axes(figure, areaOf(world, run)).paint();
  figure.text({kFigureLayout.left_px, kTitleY_px}, title, kTitle_px, kInkColor);
  paintScale(figure);
  paintLegend(figure, painter, run);
  return figure.finish();
}

}  // namespace robosim
