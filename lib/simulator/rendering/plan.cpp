#include "rendering/plan.h"

#include <utility>

#include "base/atomic_file.h"
#include "rendering/legend.h"
#include "rendering/run_painter.h"

namespace robosim {

PlanView planView(const World& world, const DrawnRun& run) { return PlanView(areaOf(world, run)); }

std::string planPicture(PictureFormat format, const World& world, const Fleet& fleet, const DrawnRun& whole) {
  const PlanView view = planView(world, whole);
  const DrawnRun run = reduced(world, whole, view.pixelsPerMetre());
  const std::string& title = run.title.empty() ? world.name : run.title;
  Figure figure(view, kPageColor, {.format = format, .title = title});
  RunPainter painter(figure, world, fleet, run, {});
  painter.paintGround();
  painter.paintRobots();
  painter.paintEvents();
  painter.paintNames();

  figure.text({kPlanLayout.left_px, kPlanLayout.top_px / 2}, title, 13, kInkColor);
  const double y = view.height() - kPlanLayout.bottom_px / 2;
  drawScale(figure, {kPlanLayout.left_px, y});
  std::vector<LegendEntry> entries;
  if (run.density) entries.push_back(LegendEntry::ofDensity(*run.density));
  if (!run.paths.empty() && run.has_starts) entries.push_back(LegendEntry::ofStart());
  if (!run.paths.empty()) entries.push_back(LegendEntry::ofEnd());
  if (!entries.empty()) {
    const auto width_of = [&](const std::string& text) { return figure.textWidth(text, kTextSize_px); };
    const Legend legend(std::move(entries), kTextSize_px, view.width(), width_of);
    legend.paint(figure, painter, view.width() - kPlanLayout.right_px, y);
  }
  return figure.finish();
}

DrawnRun startOf(const Fleet& fleet) {
  DrawnRun start;
  for (const auto& robot : fleet.robots) start.world_from_robot.emplace_back(robot.world_from_start);
  return start;
}

void writePlan(const std::filesystem::path& file, const World& world, const Fleet& fleet, const DrawnRun& run) {
  const PictureFormat format = requirePictureFormat(file);
  AtomicFile whole(file);
  whole.write(planPicture(format, world, fleet, run));
  whole.commit();
}

void checkPlanFile(const std::filesystem::path& file) {
  requirePictureFormat(file);
  checkWritable(file);
}

}  // namespace robosim
