#include "robots/robot_colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace robosim {
namespace {

bool hasOwnColor(const RobotPlacement& placement) {
  return placement.body ? placement.body->color != Body{}.color : placement.color.has_value();
}

/// 0xRRGGBB
std::uint32_t rgbOf(const std::array<float, 3>& color) {
  std::uint32_t rgb = 0;
  for (const float part : color) rgb = rgb << 8 | static_cast<std::uint32_t>(part * 255 + 0.5F);
  return rgb;
}

}  // namespace

std::array<float, 3> paletteColor(std::size_t robot) {
  static constexpr std::array<float, 3> kFirst[] = {{0.84f, 0.15f, 0.16f}, {0.12f, 0.42f, 0.75f}, {0.17f, 0.57f, 0.22f},
                                                    {0.56f, 0.27f, 0.68f}, {0.93f, 0.46f, 0.05f}, {0.07f, 0.60f, 0.65f},
                                                    {0.83f, 0.22f, 0.58f}, {0.49f, 0.36f, 0.22f}};
  if (robot < std::size(kFirst)) return kFirst[robot];
  const double hue = std::fmod(static_cast<double>(robot) * 0.381966, 1) * 6;
  std::array<float, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double offset = std::fmod(hue + 2.0 * static_cast<double>(3 - i), 6) - 3;
    color[i] = static_cast<float>(std::clamp(std::abs(offset) - 1, 0.0, 1.0)) * 0.75f + 0.05f;
  }
  return color;
}

void setRobotColors(const World& world, Fleet& fleet) {
  std::map<std::array<float, 3>, std::size_t> count;  // of robots without a colour, by their types' colour
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (!hasOwnColor(world.robots[i])) ++count[fleet.robots[i].color];
  }
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    auto& color = fleet.robots[i].color;
    if (!hasOwnColor(world.robots[i]) && count[color] > 1) color = paletteColor(i);
    fleet.robots[i].info.color_rgb = rgbOf(color);
  }
}

void setColorOfLast(Fleet& fleet, const std::optional<std::array<float, 3>>& own) {
  FleetRobot& last = fleet.robots.back();
  auto& color = last.color;
  const auto has_color = [&](const FleetRobot& other) { return &other != &last && other.color == color; };
  if (own) {
    color = *own;
  } else if (std::any_of(fleet.robots.begin(), fleet.robots.end(), has_color)) {
    color = paletteColor(fleet.robots.size() - 1);
  }
  last.info.color_rgb = rgbOf(color);
}

}  // namespace robosim
