#include "rendering/figure.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/testing/test_folder.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPoint2D;

const GroundView kView(200, 100, {0, 0}, 20);  // 10 m × 5 m

/// Draws in one of the formats, and converts the result to pixels by the format's usual program.
class FigureFile : public TestFolder {
 protected:
  using Draw = std::function<void(Figure&)>;

  static std::string bytes(PictureFormat format, const Draw& draw) {
    Figure figure(kView, {1, 1, 1}, {.format = format, .title = "a <small> & simple world"});
    draw(figure);
    return figure.finish();
  }

  cv::Mat pixels(PictureFormat format, const Draw& draw) const {
    const char* const names[] = {"a.png", "a.svg", "a.pdf"};
    const char* const commands[] = {"true", "rsvg-convert a.svg -o a.png", "pdftoppm -r 96 -png -singlefile a.pdf a"};
    const auto i = static_cast<std::size_t>(format);
    std::ofstream(folder_ / names[i]) << bytes(format, draw);
    const ToolRun converted = runTool(commands[i], folder_);
    EXPECT_EQ(converted.exit_code, 0) << converted.output;
    return cv::imread((folder_ / "a.png").string());
  }
};

constexpr PictureFormat kFormats[] = {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf};

Outline box(const mrpt::math::TPose2D& pose, double length_m, double width_m) {
  return OrientedBox::from(pose, length_m, width_m);
}

/// Something of everything.
void drawScene(Figure& figure) {
  figure.glow(Circle{{3, 1}, 0.5}, 20, {1, 0.5f, 0});
  figure.fill(Circle{{3, 1}, 0.5}, {0, 0.5f, 0});
  figure.fill(box({-2, 0, std::numbers::pi / 6}, 3, 1), {0, 0, 1});
  figure.outline(box({-2, 0, std::numbers::pi / 6}, 3, 1), 2, {1, 0, 0});
  const TPoint2D path[] = {{10, 80}, {60, 90}, {150, 70}}, triangle[] = {{176, 70}, {196, 70}, {186, 90}};
  figure.polyline(path, 3, {0.5f, 0, 0.5f});
  figure.polygon(triangle, {0, 1, 1});
  figure.text({20, 15}, "Jürgen Ω", 10, {0, 0, 0});
}

cv::Vec3b at(const cv::Mat& picture, const TPoint2D& world) {
  const TPoint2D pixel = kView.toPixel(world);
  return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return cv::mean(difference.reshape(1))[0];
}

TEST_F(FigureFile, ShowsTheSameInEveryFormat) {
  const cv::Mat png = pixels(PictureFormat::png, drawScene);
  ASSERT_EQ(png.size(), cv::Size(200, 100));
  const cv::Mat svg = pixels(PictureFormat::svg, drawScene);
  ASSERT_EQ(svg.size(), png.size());
  EXPECT_LT(meanDifference(png, svg), 0.5) << "of 255: coordinates are rounded";
  const cv::Mat pdf = pixels(PictureFormat::pdf, drawScene);
  ASSERT_EQ(pdf.size(), png.size());
  const double of_a_pixel = meanDifference(png(cv::Rect(1, 0, 199, 100)), png(cv::Rect(0, 0, 199, 100)));
  EXPECT_LT(meanDifference(png, pdf), of_a_pixel / 2) << "pdftoppm antialiases edges in another way";
}

TEST_F(FigureFile, DrawsShapesInTheirColoursAtTheirPositions) {
  for (const auto format : kFormats) {
    const cv::Mat picture = pixels(format, drawScene);
    EXPECT_EQ(at(picture, {3, 1}), cv::Vec3b(0, 128, 0));
    EXPECT_EQ(at(picture, {3.4, 1}), cv::Vec3b(0, 128, 0)) << "2 pixels inside the cylinder";
    EXPECT_GT(at(picture, {3.6, 1})[2], at(picture, {3.6, 1})[0] + 60) << "the glow beside it";
    EXPECT_EQ(at(picture, {-4.5, 2.3}), cv::Vec3b(255, 255, 255));
    const double along_x = 1.3 * std::cos(std::numbers::pi / 6), along_y = 1.3 * std::sin(std::numbers::pi / 6);
    EXPECT_EQ(at(picture, {-2 + along_x, along_y}), cv::Vec3b(255, 0, 0)) << "turned counter-clockwise";
    EXPECT_EQ(at(picture, {-2 + along_x, -along_y}), cv::Vec3b(255, 255, 255));
    EXPECT_EQ(picture.at<cv::Vec3b>(76, 186), cv::Vec3b(255, 255, 0)) << "the triangle";
    EXPECT_EQ(picture.at<cv::Vec3b>(90, 60), cv::Vec3b(128, 0, 128)) << "the path";
  }
}

TEST_F(FigureFile, HasEqualBytesForEqualDrawings) {
  for (const auto format : kFormats) EXPECT_TRUE(bytes(format, drawScene) == bytes(format, drawScene));
}

TEST_F(FigureFile, WritesTextThatAPdfReaderFinds) {
  pixels(PictureFormat::pdf, drawScene);
  EXPECT_NE(runTool("pdftotext a.pdf -", folder_).output.find("Jürgen Ω"), std::string::npos);
  const std::string info = runTool("pdfinfo a.pdf", folder_).output;
  EXPECT_NE(info.find("a <small> & simple world"), std::string::npos) << info;
  EXPECT_NE(info.find("150 x 75 pts"), std::string::npos) << info;
}

TEST_F(FigureFile, DrawsTextOfAnyBytes) {
  for (const auto format : kFormats) {
    const cv::Mat picture = pixels(format, [](Figure& figure) {
      figure.text({20, 50}, "\xff\x01\n<&\xe2\x82", 10, {0, 0, 0});
    });
    EXPECT_LT(cv::mean(picture(cv::Rect(20, 40, 20, 20)))[0], 250) << "something is drawn";
  }
}

TEST_F(FigureFile, MeasuresTextsAsTheyAreDrawn) {
  Figure figure(kView, {1, 1, 1}, {});
  EXPECT_EQ(figure.textWidth("", 10), 0);
  const double width_px = figure.textWidth("HHHHH", 10);
  EXPECT_NEAR(width_px, 5 * 0.752 / 0.73 * 10, 1) << "DejaVu Sans: an H is 0.752 em wide, and 0.73 em high";
  EXPECT_NEAR(figure.textWidth("HHHHH", 20), 2 * width_px, 0.1);
  const cv::Mat picture = pixels(PictureFormat::png, [](Figure& drawn) { drawn.text({50, 50}, "H", 20, {0, 0, 0}); });
  cv::Mat dark;
  cv::inRange(picture, cv::Scalar(0, 0, 0), cv::Scalar(100, 100, 100), dark);
  const cv::Rect covered = cv::boundingRect(dark);
  EXPECT_NEAR(covered.y + covered.height / 2.0, 50.5, 1) << "vertically centred";
  EXPECT_NEAR(covered.height, 20, 1);
}

TEST_F(FigureFile, LeavesOutTheRimOfATextOnAUniformBackground) {
  const auto with = [&](bool on_a_line) {
    return pixels(PictureFormat::png, [&](Figure& figure) {
      figure.fill(box({0, 0, 0}, 10, 5), {0.5f, 0.5f, 0.5f});
      if (on_a_line) figure.line({0, 50}, {199, 50}, 1, {0, 0, 1});
      figure.text({50, 50}, "H", 20, {0, 0, 0});
    });
  };
  double brightest = 0;
  cv::minMaxLoc(with(false).reshape(1), nullptr, &brightest);
  EXPECT_EQ(brightest, 128);
  cv::minMaxLoc(with(true).reshape(1)(cv::Rect(150, 30, 60, 18)), nullptr, &brightest);
  EXPECT_EQ(brightest, 255);
}

TEST_F(FigureFile, ComparesContrastInPixelsOfTheView) {
  for (const double scale : {1.0, 2.0}) {
    Figure figure(kView, {1, 1, 1}, {.format = PictureFormat::pdf, .png_scale = scale});
    figure.disc({100, 50}, 10, {0, 0, 0});
    EXPECT_GT(figure.contrast({85, 115, 35, 65}), 100);
    EXPECT_EQ(figure.contrast({120, 150, 35, 65}), 0);
    EXPECT_EQ(figure.contrast({95, 105, 45, 55}), 0) << "inside the disc";
  }
}

/// A chequered map of cells of 0.4 m, 8 pixels.
FloorPlan chequered(std::uint32_t columns, std::uint32_t rows) {
  FloorPlan plan;
  plan.columns = columns;
  plan.rows = rows;
  plan.cell_m = 0.4;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = row % 2; column < columns; column += 2) plan.occupied.push_back({column, row, 1, 1});
  }
  return plan;
}

TEST_F(FigureFile, DrawsCellsOfAMapAsAPathOrAsAnImage) {
  const FloorPlan few = chequered(20, 10);
  const FloorPlan many = chequered(240, 120);  // of which the picture shows a part
  for (const auto format : kFormats) {
    for (const FloorPlan* plan : {&few, &many}) {
      const cv::Mat picture = pixels(format, [&](Figure& figure) {
        figure.fillCells(*plan, {-4, -2, 0}, {0.5f, 0, 0});
      });
      for (const auto& [column, row] : {std::pair{0, 0}, std::pair{10, 6}, std::pair{19, 9}, std::pair{5, 6}}) {
        const cv::Vec3b expected = (row + column) % 2 == 0 ? cv::Vec3b(0, 0, 128) : cv::Vec3b(255, 255, 255);
        const cv::Vec3b seen = at(picture, {-4 + 0.4 * (column + 0.5), -2 + 0.4 * (row + 0.5)});
        // Half a pixel from the middle of a cell, rsvg-convert 2.54 interpolates an image by 1/16 in each direction,
        // whatever the document says.
        EXPECT_LE(cv::norm(seen, expected, cv::NORM_INF), format == PictureFormat::svg && plan == &many ? 40 : 0)
            << column << ", " << row << " of " << plan->occupied.size() << " in format " << static_cast<int>(format);
      }
    }
  }
  const auto svg = [&](const FloorPlan& plan) {
    return bytes(PictureFormat::svg, [&](Figure& figure) { figure.fillCells(plan, {-4, -2, 0}, {0.5f, 0, 0}); });
  };
  EXPECT_EQ(svg(few).find("<image"), std::string::npos);
  EXPECT_NE(svg(many).find("<image"), std::string::npos);
  EXPECT_LT(svg(many).size(), 20'000u);
}

TEST_F(FigureFile, ShowsWallsOfAMapWithCellsSmallerThanAPixel) {
  FloorPlan plan;
  plan.columns = plan.rows = 20'000;
  plan.cell_m = 0.0005;  // a hundredth of a pixel
  for (std::uint32_t column = 0; column < 20'000; ++column) plan.occupied.push_back({column, 5000, 1, 50});
  const cv::Mat picture = pixels(PictureFormat::png, [&](Figure& figure) {
    figure.fillCells(plan, {-5, -5, 0}, {0, 0, 0});
  });
  // The wall is half a pixel thick, from y = -2.5 m.
  for (int x = 2; x < 198; ++x) EXPECT_NEAR(cv::sum(255 - picture.col(x))[0], 127, 30) << x;
}

TEST_F(FigureFile, RejectsAViewThatIsTooLarge) {
  EXPECT_THROW(Figure(GroundView(40'000, 10, {0, 0}, 1), {1, 1, 1}, {}), std::runtime_error);
}

}  // namespace
}  // namespace robosim
