// Figures on paper: sizes in millimetres and points, ranges of sensors, gaps, and labels that do not overlap.

#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/testing/test_folder.h"
#include "hardware/sensor_info.h"
#include "rendering/run_figure.h"
#include "rendering/snapshot_run.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// A word of a PDF document [points], with the height of its font.
struct Word {
  std::string text;
  Bounds2D box;
};

/// Figures of a hall of 10 m × 5 m.
class FigurePageTest : public TestFolder {
 protected:
  FigurePageTest() {
    world_.name = "hall";
    world_.bounds = {0, 10, 0, 5};
  }

  void addRobot(const std::string& name, const TPose2D& pose) {
    FleetRobot robot;
    robot.info.name = name;
    robot.info.radius_m = 0.1;
    robot.info.sensors = std::make_shared<const std::vector<SensorInfo>>();
    fleet_.robots.push_back(robot);
    run_.world_from_robot.emplace_back(pose);
  }
  std::string draw(PictureFormat format, const FigurePage& page = kColumnPage) const {
    return runFigure(format, world_, fleet_, run_, page);
  }
  std::vector<Word> words(const FigurePage& page = kColumnPage) const {
    std::ofstream(folder_ / "a.pdf") << draw(PictureFormat::pdf, page);
    const std::string html = runTool("pdftotext -bbox a.pdf -", folder_).output;
    const std::regex word(R"re(<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">(.*?)</word>)re");
    std::vector<Word> found;
    for (std::sregex_iterator at(html.begin(), html.end(), word), end; at != end; ++at) {
      const auto number = [&](std::size_t i) { return std::stod((*at)[i]); };
      found.push_back({(*at)[5], {number(1), number(3), number(2), number(4)}});
    }
    return found;
  }
  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  }

  World world_;
  Fleet fleet_;
  DrawnRun run_;
};

TEST_F(FigurePageTest, HasItsWidthInMillimetres) {
  const std::string svg = draw(PictureFormat::svg);
  EXPECT_NE(svg.find(" width=\"88mm\" height=\""), std::string::npos) << svg.substr(0, 300);
  for (const auto& [width_mm, size] : {std::pair{88.0, "249.449 x"}, std::pair{180.0, "510.236 x"}}) {
    std::ofstream(folder_ / "a.pdf") << draw(PictureFormat::pdf, {width_mm, 8});
    const std::string info = runTool("pdfinfo a.pdf", folder_).output;
    EXPECT_NE(info.find(size), std::string::npos) << width_mm << " mm: " << info;  // 72 points per 25.4 mm
  }
  // A tall world is at most √2 times as high as wide.
  world_.bounds = {0, 1, 0, 100};
  const GroundView view = figureView(world_, run_, kColumnPage);
  EXPECT_NEAR(view.height(), view.width() * M_SQRT2, 1.5);
}

TEST_F(FigurePageTest, HasTextOfTheRequestedSize) {
  addRobot("Ann", {5, 2, 0});
  std::ofstream(folder_ / "a.pdf") << draw(PictureFormat::pdf, {120, 11});
  // pdftohtml reports sizes in its pixels: 1.5 per point.
  const std::string xml = runTool("pdftohtml -xml -stdout a.pdf", folder_).output;
  const std::regex font(R"re(<fontspec id="\d+" size="(\d+)")re");
  std::vector<int> sizes;
  for (std::sregex_iterator at(xml.begin(), xml.end(), font), end; at != end; ++at)
    sizes.push_back(std::stoi((*at)[1]));
  std::sort(sizes.begin(), sizes.end());
  ASSERT_FALSE(sizes.empty()) << xml;
  EXPECT_NEAR(sizes.front(), 1.5 * 11, 1) << xml;
  EXPECT_NEAR(sizes.back(), 1.5 * 11 * 4 / 3, 1) << "the title";
}

TEST_F(FigurePageTest, RefusesTextWithoutRoom) {
  try {
    draw(PictureFormat::svg, {20, 40});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "a figure 20 mm wide has no room for text of 40 pt beside its plan; make it wider or the text smaller");
  }
}

TEST_F(FigurePageTest, HasNoOverlappingLabelsOfThirtyCrowdedRobots) {
  world_.name = "a hall with a long name that does not fit beside the scale";
  for (int i = 0; i < 30; ++i) {
    addRobot("Robot" + std::to_string(i + 1), {4.2 + 0.35 * (i % 6), 1.6 + 0.35 * (i / 6), 0});
    run_.paths.push_back({{1, 1}, {4, 2}});
  }
  run_.events = {
      {RunEvent::Kind::gold, 0, {2, 4}}, {RunEvent::Kind::message, 0, {4, 4}}, {RunEvent::Kind::stall, 0, {6, 4}}};
  for (const FigurePage& page : {FigurePage{88, 8}, FigurePage{60, 6}, FigurePage{180, 9}}) {
    const auto labels = words(page);
    std::size_t names = 0;
    const double width_pt = page.width_mm / 25.4 * 72;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto& [text, a] = labels[i];
      names += text.starts_with("Robot") ? 1 : 0;
      EXPECT_GE(a.x_min, 0) << text;
      EXPECT_LE(a.x_max, width_pt) << text;
      for (std::size_t k = 0; k < i; ++k) {
        const Bounds2D& b = labels[k].box;
        EXPECT_FALSE(a.x_min < b.x_max && b.x_min < a.x_max && a.y_min < b.y_max && b.y_min < a.y_max)
            << text << " and " << labels[k].text << " at " << page.width_mm << " mm";
      }
    }
    EXPECT_GE(names, 8U) << "those at the edge of the crowd, at " << page.width_mm << " mm";
  }
}

TEST_F(FigurePageTest, HasATranslucentPolygonForEachSonarAndOneForAScan) {
  addRobot("Ann", {5, 2, 0});
  SensorInfo sonar, laser;
  sonar.kind = SensorKind::sonar;
  sonar.beam_width_rad = 0.3;
  sonar.range_max_m = 5;
  laser.kind = SensorKind::laser;
  laser.range_max_m = 8;
  Echoes sonars, scan;
  for (int i = 0; i < 16; ++i) {
    sonar.beams.emplace_back().robot_from_beam.yaw = i * M_PI / 8;
    sonars.push_back({.range_m = 1.5, .point_m = {1.5, 0, 0}});
  }
  for (int i = 0; i < 181; ++i) {
    const double angle_rad = toRadians(i - 90);
    laser.beams.emplace_back().robot_from_beam.yaw = angle_rad;
    scan.push_back(
        {.range_m = 2,
         .point_m = {static_cast<float>(2 * std::cos(angle_rad)), static_cast<float>(2 * std::sin(angle_rad)), 0}});
  }
  fleet_.robots[0].info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector{sonar, laser});
  RunSnapshot snapshot;
  snapshot.robots.emplace_back().world_from_robot = {5, 2, 0};
  snapshot.robots[0].readings.emplace().measurements = {sonars, scan};
  run_ = drawnRun(fleet_, snapshot, RunPaths(), {});
  const std::string svg = draw(PictureFormat::svg);
  EXPECT_EQ(count(svg, "fill-opacity:0.17"), 17U);
  EXPECT_EQ(count(svg, "<image"), 0U) << "vectors";
  // Absent robots measure nothing.
  snapshot.robots[0].activity = Activity::absent;
  run_ = drawnRun(fleet_, snapshot, RunPaths(), {});
  EXPECT_EQ(count(draw(PictureFormat::svg), "fill-opacity:0.17"), 0U);
}

TEST_F(FigurePageTest, DrawsNoLineOverTheGapOfAPath) {
  addRobot("Ann", {9, 1, 0});
  RunPaths paths;
  const TPose2D absent(std::nan(""), std::nan(""), 0);
  for (int i = 0; i <= 10; ++i) paths.add(static_cast<std::uint64_t>(i), i, {{1 + 0.1 * i, 1, 0}});
  for (int i = 11; i < 20; ++i) paths.add(static_cast<std::uint64_t>(i), i, {absent});
  for (int i = 20; i <= 30; ++i) paths.add(static_cast<std::uint64_t>(i), i, {{8 + 0.1 * (i - 20), 1, 0}});
  RunSnapshot snapshot{30, 30, {}};
  snapshot.robots.emplace_back().world_from_robot = {9, 1, 0};
  run_ = drawnRun(fleet_, snapshot, paths, {});
  ASSERT_EQ(run_.paths.size(), 1U);
  EXPECT_EQ(std::count_if(run_.paths[0].begin(), run_.paths[0].end(), isGap), 1);
  const auto gap = std::find_if(run_.paths[0].begin(), run_.paths[0].end(), isGap);
  EXPECT_NEAR((gap - 1)->x, 2, 1e-9) << "where it was last seen";
  EXPECT_NEAR((gap + 1)->x, 8, 1e-9);
  const auto lines = [&] { return count(draw(PictureFormat::svg), "stroke-width:1.6;"); };
  EXPECT_EQ(lines(), 2U);
  // While it is absent, its path ends where it was last seen.
  snapshot.robots[0].activity = Activity::absent;
  snapshot.time_s = 15;
  run_ = drawnRun(fleet_, snapshot, paths, {});
  EXPECT_EQ(lines(), 1U);
  EXPECT_NEAR(run_.paths[0].back().x, 2, 1e-9);
}

}  // namespace
}  // namespace robosim
