#include "rendering/legend.h"

#include <algorithm>
#include <utility>

#include "rendering/density_painter.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

const Color kMarkColor = mix(kPageColor, kInkColor, 0.7f);

}  // namespace

LegendEntry LegendEntry::ofStart() {
  return {"start", kStartMark_px, [](RunPainter& painter, const TPoint2D& at) { painter.paintStart(at, kMarkColor); }};
}

LegendEntry LegendEntry::ofEnd() {
  return {"end", kEndMark_px, [](RunPainter& painter, const TPoint2D& at) { painter.paintEnd(at, kMarkColor); }};
}

LegendEntry LegendEntry::ofDensity(const DensityMap& map) {
  return {map.legend(), kDensityScale_px,
          [](RunPainter& painter, const TPoint2D& at) { painter.paintDensityScale(at); }};
}

std::vector<LegendEntry> makeLegend(const DrawnRun& run) {
  std::vector<LegendEntry> entries;
  if (run.density) entries.push_back(LegendEntry::ofDensity(*run.density));
  const std::pair<SensorKind, const char*> sensors[] = {{SensorKind::sonar, "sonar"},
                                                        {SensorKind::laser, "laser"},
                                                        {SensorKind::infrared, "infrared"},
                                                        {SensorKind::beacons, "beacon"},
                                                        {SensorKind::values, "bearing"}};
  for (const auto& [kind, word] : sensors) {
    const auto is_of_kind = [kind = kind](const SensedArea& sensed) { return sensed.kind == kind; };
    if (std::none_of(run.sensed.begin(), run.sensed.end(), is_of_kind)) continue;
    entries.push_back({word, kSensorMark_px,
                       [kind = kind](RunPainter& painter, const TPoint2D& at) { painter.paintSensor(kind, at); }});
  }
  const auto has_points = [](const auto& path) { return !path.empty(); };
  if (std::any_of(run.paths.begin(), run.paths.end(), has_points)) {
    if (run.has_starts) entries.push_back(LegendEntry::ofStart());
    entries.push_back(LegendEntry::ofEnd());
  }
  const std::pair<RunEvent::Kind, const char*> events[] = {{RunEvent::Kind::gold, "gold found"},
                                                           {RunEvent::Kind::message, "message sent"},
                                                           {RunEvent::Kind::stall, "stall"}};
  for (const auto& [kind, word] : events) {
    const auto is_of_kind = [kind = kind](const RunEvent& event) { return event.kind == kind; };
    if (std::none_of(run.events.begin(), run.events.end(), is_of_kind)) continue;
    entries.push_back({word, kEventMark_px, [kind = kind](RunPainter& painter, const TPoint2D& at) {
                         painter.paintEvent(kind, at, kMarkColor);
                       }});
  }
  return entries;
}

Legend::Legend(std::vector<LegendEntry> entries, double text_px, double width_px,
               const std::function<double(const std::string& word)>& width_of)
    : text_px_(text_px) {
  const double mark_gap_px = 0.7 * text_px, entry_gap_px = 2 * text_px;
  for (auto& entry : entries) {
    const double entry_px = entry.mark_px + mark_gap_px + width_of(entry.word);
    const bool fits = !lines_.empty() && lines_.back().width_px + entry_gap_px + entry_px <= width_px;
    Line& line = fits ? lines_.back() : lines_.emplace_back();
    const double left = fits ? line.width_px + entry_gap_px : 0;
    const double mark_px = entry.mark_px;
    line.entries.push_back({std::move(entry), left + mark_px / 2, left + mark_px + mark_gap_px});
    line.width_px = left + entry_px;
  }
}

void Legend::paint(Figure& figure, RunPainter& painter, double right, double y) const {
  for (const auto& line : lines_) {
    const double left = right - line.width_px;
    for (const auto& placed : line.entries) {
      placed.entry.paint_mark(painter, {left + placed.mark_center, y});
      figure.text({left + placed.word_left, y}, placed.entry.word, text_px_, kInkColor);
    }
    y += linePitch();
  }
}

}  // namespace robosim
