#include "rendering/density_painter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rendering/air_view.h"
#include "rendering/ground_painter.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kOpacity = 0.9;  ///< the floor's grid shines through

const std::vector<Color>& levelColors() {
  static const std::vector<Color> colors = [] {
    std::vector<Color> all;
    for (int level = 1; level <= DensityMap::kLevels; ++level) all.push_back(DensityMap::colorOf(level));
    return all;
  }();
  return colors;
}

}  // namespace

void drawDensity(DrawingSurface& surface, const DensityMap& map) {
  surface.fillGrid(map.levels(), map.upperLeft(), map.cell(), levelColors(), kOpacity);
}

void tintGround(const AirPicture& air, const DensityMap& map) {
  // Of the depth of the ground: the step of a depth buffer of 24 bits grows with the square of the distance.
  constexpr double kSlack_m = 0.02, kSlackPerSquare = 2.0 / (1 << 24) / static_cast<double>(kNearPlane_m);
  const AirView view(air);
  const auto rotation = air.world_from_camera.getRotationMatrix();
  const TPoint2D camera(air.world_from_camera.x, air.world_from_camera.y), corner = map.upperLeft();
  const cv::Mat levels = map.levels();
  for (int y = 0; y < air.picture.rows; ++y) {
    auto* const pixels = air.picture.ptr<cv::Vec3b>(y);
    const double up = -(y - view.middle().y) / view.focalLength();
    for (int x = 0; x < air.picture.cols; ++x) {
      const double left = -(x - view.middle().x) / view.focalLength();
      // Of a point 1 m ahead, in the world's axes.
      const double down = rotation(2, 0) + rotation(2, 1) * left + rotation(2, 2) * up;
      if (down >= 0) continue;
      const double ahead_m = -air.world_from_camera.z / down;
      const double across_x = rotation(0, 0) + rotation(0, 1) * left + rotation(0, 2) * up;
      const double across_y = rotation(1, 0) + rotation(1, 1) * left + rotation(1, 2) * up;
      const double column = std::floor((camera.x + ahead_m * across_x - corner.x) / map.cell());
      const double row = std::floor((corner.y - camera.y - ahead_m * across_y) / map.cell());
      if (!(column >= 0 && row >= 0 && column < levels.cols && row < levels.rows)) continue;
      const int level = levels.at<std::uint8_t>(static_cast<int>(row), static_cast<int>(column));
      if (level == 0 || !view.isVisible(TPoint2D(x, y), ahead_m, kSlack_m + kSlackPerSquare * ahead_m * ahead_m, 0))
        continue;
      const Color& color = levelColors()[static_cast<std::size_t>(level - 1)];
      for (int i = 0; i < 3; ++i) {
        const double paint = 255.0 * static_cast<double>(color[static_cast<std::size_t>(2 - i)]);
        pixels[x][i] = static_cast<std::uint8_t>(std::lround(pixels[x][i] + (paint - pixels[x][i]) * kOpacity));
      }
    }
  }
}

void drawDensityScale(DrawingSurface& surface, const TPoint2D& center, double scale) {
  const double width_px = kDensityScale_px * scale / DensityMap::kLevels, half_px = 5 * scale;
  const double left = center.x - kDensityScale_px * scale / 2;
  for (int i = 0; i < DensityMap::kLevels; ++i) {
    const double x = left + i * width_px;
    const TPoint2D corners[] = {{x, center.y - half_px},
                                {x + width_px, center.y - half_px},
                                {x + width_px, center.y + half_px},
                                {x, center.y + half_px}};
    surface.polygon(corners, levelColors()[static_cast<std::size_t>(i)]);
  }
  const double right = left + kDensityScale_px * scale, top = center.y - half_px, low = center.y + half_px;
  const TPoint2D rim[] = {{left, top}, {right, top}, {right, low}, {left, low}, {left, top}};
  surface.polyline(rim, 0.8 * scale, kInkColor);
}

void drawDensityLegend(DrawingSurface& surface, const DensityMap& map, double scale) {
  const std::string text = map.legend();
  const double text_px = kTextSize_px * scale, gap_px = 8 * scale, edge_px = 14 * scale;
  const double y = surface.view().height() - 18 * scale;
  const double text_left = surface.view().width() - edge_px - surface.textWidth(text, text_px);
  surface.text({text_left, y}, text, text_px, kInkColor);
  drawDensityScale(surface, {text_left - gap_px - kDensityScale_px * scale / 2, y}, scale);
}

}  // namespace robosim
