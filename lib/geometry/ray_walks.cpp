#include "geometry/ray_walks.h"

#include <cmath>
#include <limits>

#include "geometry/grid_index.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Choices are made of whole numbers that are -1 for yes and 0 for no: GCC makes no vector instructions of a loop with
/// a condition that reads memory only if it holds.
using Choice = std::int64_t;

/// One axis of a grid.
struct GridAxis {
  double low_m, cell_m, per_m;
  std::int64_t count;   ///< of cells
  std::int64_t stride;  ///< from a cell's number to the next one's
};

ROBOSIM_VECTOR_CLONES
void startAlong(const GridAxis& axis, const double* __restrict from, const double* __restrict direction,
                RayWalks::Axis& along, std::int64_t* __restrict cell) {
  const auto [low_m, cell_m, per_m, count, stride] = axis;
  const double last = static_cast<double>(count - 1);
  for (std::size_t i = 0; i < RayWalks::kMost; ++i) {
    const double in_cells = (from[i] - low_m) * per_m;
    const double on_grid = in_cells > 0 ? (in_cells < last ? in_cells : last) : 0.0;
    const std::int64_t at = static_cast<std::int32_t>(on_grid);
    const Choice up = direction[i] > kLeastSlope ? -1 : 0;
    const Choice down = direction[i] < -kLeastSlope ? -1 : 0;
    const std::int64_t left = (up & (count - 1 - at)) + (down & at);
    const double per = 1 / direction[i];
    const double next_m = (low_m + static_cast<double>(at - up) * cell_m - from[i]) * per;
    const double delta_m = cell_m * std::abs(per);
    along.next_m[i] = left == 0 ? kInfinity : next_m;
    along.delta_m[i] = left == 0 ? 0.0 : delta_m;
    along.left[i] = left;
    along.step[i] = (up & stride) - (down & stride);
    cell[i] += at * stride;
  }
}

/// The next border, for those who cross it.
[[gnu::always_inline]] inline void cross(RayWalks::Axis& along, std::size_t i, Choice crosses) {
  const std::int64_t left = along.left[i] + crosses;
  const double next_m = along.next_m[i];
  const double after_m = next_m + along.delta_m[i];
  const double then_m = crosses != 0 ? after_m : next_m;
  along.left[i] = left;
  along.next_m[i] = left == 0 ? kInfinity : then_m;
}

ROBOSIM_VECTOR_CLONES
void goOnAll(RayWalks& walks) {
  for (std::size_t i = 0; i < RayWalks::kMost; ++i) {
    const std::int64_t next_pack = walks.pack[i] + 1;
    const double next_x_m = walks.along_x.next_m[i];
    const double next_y_m = walks.along_y.next_m[i];
    const double reach_m = walks.reach_m[i];
    const std::int64_t step_x = walks.along_x.step[i];
    const std::int64_t step_y = walks.along_y.step[i];
    const double border_m = next_x_m <= next_y_m ? next_x_m : next_y_m;
    const Choice in_cell = next_pack < walks.end_pack[i] ? -1 : 0;
    const Choice in_reach = border_m < reach_m ? -1 : 0;
    const Choice first_x = next_x_m <= next_y_m ? -1 : 0;
    const Choice to_next_cell = ~in_cell & in_reach;
    const Choice crosses_x = to_next_cell & first_x;
    const Choice crosses_y = to_next_cell & ~first_x;
    walks.goes_on[i] = in_cell | to_next_cell;
    walks.cell[i] += (crosses_x & step_x) + (crosses_y & step_y);
    walks.pack[i] = next_pack;
    cross(walks.along_x, i, crosses_x);
    cross(walks.along_y, i, crosses_y);
  }
}

void fillUp(RayWalks& walks) {
  for (std::size_t k = walks.going_count; k % RayWalks::kTogether != 0; ++k) walks.going[k] = walks.going[0];
}

}  // namespace

void GridIndex::start(RayWalks& walks) const {
  walks.cell = {};
  startAlong({area_.x_min, cell_m_, per_m_, columns_, 1}, walks.x.of, walks.dx.of, walks.along_x, walks.cell.of);
  startAlong({area_.y_min, cell_m_, per_m_, rows_, columns_}, walks.y.of, walks.dy.of, walks.along_y, walks.cell.of);
  for (std::size_t i = 0; i < walks.going_count; ++i) {
    const auto cell = static_cast<std::size_t>(walks.cell[i]);
    walks.pack[i] = begin_[cell];
    walks.end_pack[i] = begin_[cell + 1];
    walks.going[i] = static_cast<std::uint32_t>(i);
  }
  fillUp(walks);
}

void GridIndex::goOn(RayWalks& walks) const {
  goOnAll(walks);
  const std::uint32_t* begin = begin_.data();
  std::size_t still_going = 0;
  for (std::size_t k = 0; k < walks.going_count; ++k) {
    const std::uint32_t i = walks.going[k];
    const std::int64_t cell = walks.cell[i];
    const std::int64_t first = begin[cell];
    const std::int64_t pack = walks.pack[i];
    walks.pack[i] = pack < walks.end_pack[i] ? pack : first;
    walks.end_pack[i] = begin[cell + 1];
    walks.going[still_going] = i;
    still_going -= static_cast<std::size_t>(walks.goes_on[i]);
  }
  walks.going_count = still_going;
  fillUp(walks);
}

}  // namespace robosim
