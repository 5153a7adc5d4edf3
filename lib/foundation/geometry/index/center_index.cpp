#include "geometry/index/center_index.h"

#include <array>
#include <bit>
#include <utility>

namespace robosim {
namespace {

constexpr double kCellMin_m = 0.25;
/// Added to the number of solids, so that a few solids still get several cells.
constexpr double kExtraCells = 4;

/// Interval that contains most of a set of numbers: the mean ± twice the mean absolute deviation, clipped to the
/// minimum and maximum. It covers uniformly distributed numbers; a few outliers hardly widen it.
struct Spread {
  double min, max;

  static Spread of(double mean, double deviation, double min, double max) {
    return {std::max(min, mean - 2 * deviation), std::min(max, mean + 2 * deviation)};
  }
  double extent() const { return max - min; }
};

/// The order of all items.
struct EveryItem {
  std::size_t count;
  std::size_t size() const { return count; }
  std::size_t operator[](std::size_t k) const { return k; }
};

}  // namespace

CenterIndex::CenterIndex(std::size_t solids, const mrpt::math::TPoint2D& middle)
    : middle_(middle), items_(solids), cell_(solids), entries_(solids + kTogether - 1) {
  // Upper bound of the cells that chooseCells() makes: (w / cell + 1)·(h / cell + 1), and the end.
  begin_.reserve(3 * (solids + static_cast<std::size_t>(kExtraCells)) + 2);
}

template <typename Order>
void CenterIndex::chooseCells(const ParallelExecutor& workers, const Order& order) {
  struct Centers {
    Bounds2D bounds{kInfinity, -kInfinity, kInfinity, -kInfinity};
    double reach_max_m = 0;
    double sum_x = 0, sum_y = 0;
    std::size_t solids = 0;
  };
  const auto centers_in = [&](std::size_t begin, std::size_t end) {
    Centers found;
    for (std::size_t k = begin; k < end; ++k) {
      const GridItem& item = items_[order[k]];
      if (item.isRemoved()) continue;
      ++found.solids;
      found.reach_max_m = std::max(found.reach_max_m, item.reach());
      found.bounds = {std::min(found.bounds.x_min, item.x), std::max(found.bounds.x_max, item.x),
                      std::min(found.bounds.y_min, item.y), std::max(found.bounds.y_max, item.y)};
      found.sum_x += item.x;
      found.sum_y += item.y;
    }
    return found;
  };
  const auto all = workers.reduce(order.size(), Centers{}, centers_in, [](const Centers& a, const Centers& b) {
    return Centers{{std::min(a.bounds.x_min, b.bounds.x_min), std::max(a.bounds.x_max, b.bounds.x_max),
                    std::min(a.bounds.y_min, b.bounds.y_min), std::max(a.bounds.y_max, b.bounds.y_max)},
                   std::max(a.reach_max_m, b.reach_max_m),
                   a.sum_x + b.sum_x,
                   a.sum_y + b.sum_y,
                   a.solids + b.solids};
  });
  centers_ = all.bounds;
  reach_max_m_ = all.reach_max_m;
  if (all.solids == 0) return;
  const auto count = static_cast<double>(all.solids);
  const double mean_x = all.sum_x / count, mean_y = all.sum_y / count;
  struct Deviations {
    double x = 0, y = 0;
  };
  const auto deviations_in = [&](std::size_t begin, std::size_t end) {
    Deviations sum;
    for (std::size_t k = begin; k < end; ++k) {
      const GridItem& item = items_[order[k]];
      if (item.isRemoved()) continue;
      sum.x += std::abs(item.x - mean_x);
      sum.y += std::abs(item.y - mean_y);
    }
    return sum;
  };
  const auto off =
      workers.reduce(order.size(), Deviations{}, deviations_in, [](const Deviations& a, const Deviations& b) {
        return Deviations{a.x + b.x, a.y + b.y};
      });
  const Spread x = Spread::of(mean_x, off.x / count, centers_.x_min, centers_.x_max);
  const Spread y = Spread::of(mean_y, off.y / count, centers_.y_min, centers_.y_max);
  area_ = {x.min, x.max, y.min, y.max};
  // One solid per cell, and no more columns or rows than solids when all stand in a line.
  const double cells = count + kExtraCells;
  cell_m_ = std::max({kCellMin_m, std::sqrt(x.extent() * y.extent() / cells), x.extent() / cells, y.extent() / cells});
  per_m_ = 1 / cell_m_;
  columns_ = cellsIn(x.extent(), cell_m_);
  rows_ = cellsIn(y.extent(), cell_m_);
}

void CenterIndex::buildOne(std::size_t solid) {
  const GridItem& item = items_[solid];
  centers_ = area_ = {item.x, item.x, item.y, item.y};
  reach_max_m_ = item.reach();
  cell_m_ = kCellMin_m;
  per_m_ = 1 / kCellMin_m;
  columns_ = rows_ = 1;
  begin_.resize(2);
  begin_[0] = 0;
  begin_[1] = 1;
  entries_[0] = {CullDisc::from(item, middle()), static_cast<std::uint32_t>(solid)};
}

template <typename Order>
void CenterIndex::buildFrom(const ParallelExecutor& workers, const Order& order) {
  if (order.size() == 1 && !items_[order[0]].isRemoved()) return buildOne(order[0]);
  chooseCells(workers, order);
  if (workers.threads() > 1 && ParallelExecutor::piecesOf(order.size()) > 1) return sortInParallel(workers, order);
  begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const GridItem& item = items_[i];
    if (item.isRemoved()) continue;
    cell_[i] = static_cast<std::uint32_t>(cellAt(row(item.y), column(item.x)));
    ++begin_[cell_[i]];
  }
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end until the entries are filled in
  // Filled from the back, so that each cell's end becomes its begin and its solids keep the order given.
  for (std::size_t k = order.size(); k-- > 0;) {
    const std::size_t i = order[k];
    if (items_[i].isRemoved()) continue;
    entries_[--begin_[cell_[i]]] = {CullDisc::from(items_[i], middle()), static_cast<std::uint32_t>(i)};
  }
}

// First the solids are sorted by part of the grid, as many cells in each, in the order given within a part; then each
// part by cell, as above.
template <typename Order>
void CenterIndex::sortInParallel(const ParallelExecutor& workers, const Order& order) {
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const std::size_t pieces = ParallelExecutor::piecesOf(order.size());
  const int part_bits = std::bit_width(cells / ParallelExecutor::kPiecesMax);  // of a cell's index within its part
  const std::size_t parts = (cells >> part_bits) + 1;
  using PerPart = std::array<std::uint32_t, ParallelExecutor::kPiecesMax + 1>;
  std::array<PerPart, ParallelExecutor::kPiecesMax> at{};  // by piece: numbers of solids, then their places
  const auto for_piece = [&](std::size_t piece, const auto& work) {
    for (std::size_t k = piece * order.size() / pieces; k < (piece + 1) * order.size() / pieces; ++k) {
      if (const std::size_t i = order[k]; !items_[i].isRemoved()) work(i);
    }
  };
  workers.forEach(pieces, 1, [&](std::size_t piece) {
    for_piece(piece, [&](std::size_t i) {
      cell_[i] = static_cast<std::uint32_t>(cellAt(row(items_[i].y), column(items_[i].x)));
      ++at[piece][cell_[i] >> part_bits];
    });
  });
  PerPart part_begin{};
  std::uint32_t sum = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    part_begin[part] = sum;
    for (std::size_t piece = 0; piece < pieces; ++piece) sum += std::exchange(at[piece][part], sum);
  }
  by_part_.resize(order.size());
  workers.forEach(pieces, 1, [&](std::size_t piece) {
    for_piece(piece, [&](std::size_t i) {
      by_part_[at[piece][cell_[i] >> part_bits]++] = {cell_[i], static_cast<std::uint32_t>(i)};
    });
  });
  begin_.resize(cells + 1);
  begin_[cells] = sum;
  workers.forEach(parts, 1, [&](std::size_t part) {
    const std::size_t first = part << part_bits, last = std::min(cells, (part + 1) << part_bits);
    const std::uint32_t begin = part_begin[part], end = part + 1 < parts ? part_begin[part + 1] : sum;
    std::fill(begin_.begin() + static_cast<std::ptrdiff_t>(first), begin_.begin() + static_cast<std::ptrdiff_t>(last),
              0);
    for (std::uint32_t k = begin; k < end; ++k) ++begin_[by_part_[k].cell];
    std::uint32_t in_part = begin;
    for (std::size_t cell = first; cell < last; ++cell) begin_[cell] = in_part += begin_[cell];
    for (std::uint32_t k = end; k-- > begin;) {
      const CellOf& solid = by_part_[k];
      entries_[--begin_[solid.cell]] = {CullDisc::from(items_[solid.solid], middle()), solid.solid};
    }
  });
}

void CenterIndex::build(const ParallelExecutor& workers) { buildFrom(workers, EveryItem{items_.size()}); }
void CenterIndex::build(const ParallelExecutor& workers, std::span<const std::uint32_t> solids) {
  buildFrom(workers, solids);
}

}  // namespace robosim
