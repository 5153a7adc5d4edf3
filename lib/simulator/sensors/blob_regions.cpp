#include "sensors/blob_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace robosim {
namespace {

/// Whether a pixel has a colour: its hue, saturation and value (Smith, "Color gamut transform pairs", SIGGRAPH 1978).
bool hasColor(const std::uint8_t* rgb, const TargetColor& color) {
  const auto [least, most] = std::minmax({rgb[0], rgb[1], rgb[2]});
  const double spread = most - least;
  if (most < 255 * color.value_min || spread < most * color.saturation_min) return false;
  double sixths = 0;  // of a turn; grays have the hue 0
  if (spread > 0) {
    const int main = most == rgb[0] ? 0 : most == rgb[1] ? 1 : 2;
    sixths = 2 * main + (rgb[(main + 1) % 3] - rgb[(main + 2) % 3]) / spread;
  }
  double away_rad = std::abs(sixths * (M_PI / 3) - color.hue_rad);
  away_rad = std::min(away_rad, std::abs(away_rad - 2 * M_PI));
  return away_rad <= color.within_rad;
}

/// A maximal row of neighbouring pixels of the colour, and the region that it begins, as far as it is the first run.
struct Run {
  std::uint32_t row, begin, end;
  std::size_t parent;  ///< a run of the same region; itself for the first one
};

std::size_t rootOf(std::vector<Run>& runs, std::size_t i) {
  while (runs[i].parent != i) i = runs[i].parent = runs[runs[i].parent].parent;
  return i;
}

void join(std::vector<Run>& runs, std::size_t a, std::size_t b) {
  a = rootOf(runs, a);
  b = rootOf(runs, b);
  runs[std::max(a, b)].parent = std::min(a, b);
}

std::vector<Run> runsOf(const RawPicture& picture, const TargetColor& color) {
  std::vector<Run> runs;
  std::size_t above = 0, row_begin = 0;  // first run of the row above, and of this row
  for (std::uint32_t row = 0; row < picture.height_px; ++row) {
    const std::uint8_t* const pixels = &picture.rgb[std::size_t{3} * row * picture.width_px];
    row_begin = runs.size();
    for (std::uint32_t x = 0; x < picture.width_px; ++x) {
      if (!hasColor(pixels + 3 * x, color)) continue;
      const std::uint32_t begin = x;
      while (x < picture.width_px && hasColor(pixels + 3 * x, color)) ++x;
      const std::size_t added = runs.size();
      runs.push_back({row, begin, x, added});
      while (above < row_begin && runs[above].end < begin) ++above;
      for (std::size_t other = above; other < row_begin && runs[other].begin <= x; ++other) join(runs, other, added);
    }
    above = row_begin;
  }
  return runs;
}

struct Region {
  std::uint32_t pixels = 0, left = 0, right = 0, top = 0, bottom = 0;
  std::uint64_t twice_x = 0, y = 0;  ///< sums over its pixels
};

Blob largestOf(std::vector<Run> runs, unsigned pixels_min) {
  std::vector<Region> regions(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    Region& region = regions[rootOf(runs, i)];
    const std::uint32_t size = run.end - run.begin;
    if (region.pixels == 0) region = {0, run.begin, run.end, run.row, run.row};
    region.pixels += size;
    region.left = std::min(region.left, run.begin);
    region.right = std::max(region.right, run.end);
    region.bottom = run.row;
    region.twice_x += std::uint64_t{size} * (run.begin + run.end - 1);
    region.y += std::uint64_t{size} * run.row;
  }
  const auto best = std::max_element(regions.begin(), regions.end(),
                                     [](const Region& a, const Region& b) { return a.pixels < b.pixels; });
  if (best == regions.end() || best->pixels < pixels_min) return {};
  return {.color = {},
          .pixels = best->pixels,
          .x_px = static_cast<float>(static_cast<double>(best->twice_x) / (2.0 * best->pixels)),
          .y_px = static_cast<float>(static_cast<double>(best->y) / best->pixels),
          .left_px = best->left,
          .top_px = best->top,
          .width_px = best->right - best->left,
          .height_px = best->bottom - best->top + 1};
}

}  // namespace

std::vector<Blob> findBlobs(const RawPicture& picture, const std::vector<TargetColor>& colors, unsigned pixels_min) {
  std::vector<Blob> blobs;
  for (const TargetColor& color : colors) {
    blobs.push_back(picture.rgb.empty() ? Blob{} : largestOf(runsOf(picture, color), pixels_min));
    blobs.back().color = color.name;
  }
  return blobs;
}

}  // namespace robosim
