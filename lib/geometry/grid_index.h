#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/ray.h"
#include "geometry/solid_pack.h"

namespace robosim {

struct RayWalks;

/// A ray whose direction has less than this of an axis crosses no border on it: its next one would be too far for a
/// number.
constexpr double kLeastSlope = 1e-300;

/// How many cells of a size cover an extent: at least 1, and no more than 32768.
int cellsIn(double extent_m, double cell_m);
/// The cell of a coordinate that is counted in cells, pulled onto the rim when it lies outside.
inline int cellOf(double in_cells, int count) {
  // Cast only what is in range: a far coordinate would not fit an int.
  if (!(in_cells > 0)) return 0;
  return in_cells < count ? static_cast<int>(in_cells) : count - 1;
}

/// Which solids reach into which square cell of the plane. Built by counting sort: linear time, no allocation once the
/// arrays have their size. Each cell's solids lie side by side in memory, in packs. Solids beyond the grid's area are
/// listed in the cells of its rim, which stand for all that lies outwards of them.
class GridIndex {
 public:
  using Pack = SolidPack<8>;

  GridIndex(const Bounds2D& area, double cell_m);

  /// Lists each solid in every cell that its outline reaches.
  void build(std::span<const Solid> solids);

  /// The solids, by the cell of their centre: those near each other in the plane are so in memory, too, for who asks
  /// about one soon asks about the other. Indices here are of this order; GridItem::number tells the one given.
  std::span<const GridItem> items() const { return items_; }
  std::span<const RoughSolid> rough() const { return rough_; }
  /// The index of a solid by its number.
  std::uint32_t indexOf(std::size_t number) const { return index_of_[number]; }
  /// From where the rough solids are seen.
  mrpt::math::TPoint2D middle() const { return {(area_.x_min + area_.x_max) / 2, (area_.y_min + area_.y_max) / 2}; }

  double cellSize() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double xMin() const { return area_.x_min; }
  double yMin() const { return area_.y_min; }
  /// Column or row of a coordinate, pulled onto the rim when it lies outside.
  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  /// The solids in a cell.
  std::span<const Pack> cell(int column, int row) const { return cell(cellAt(column, row)); }

  /// The packs of all cells, one cell after another; and an empty one at the end.
  std::span<const Pack> packs() const { return packs_; }

  /// Whether a cell goes on outwards without end.
  bool isOnRim(int column, int row) const {
    return column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1;
  }

  /// Visits the packs of the cells that a ray goes through, in its order, until the next cell begins at or beyond
  /// reach() (Amanatides & Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987); for an empty
  /// cell, any pack. Cells on the rim go on outwards without end.
  template <typename Reach, typename Visit>
  [[gnu::always_inline]] inline void visitAlong(const Ray& ray, const Reach& reach, const Visit& visit) const {
    const int first_column = column(ray.origin.x);
    const int first_row = row(ray.origin.y);
    std::size_t at = cellAt(first_column, first_row);
    std::uint32_t pack = begin_[at];
    std::uint32_t end = begin_[at + 1];
    Walk x = walk(ray.origin.x, ray.direction.x, area_.x_min, first_column, columns_, 1);
    Walk y = walk(ray.origin.y, ray.direction.y, area_.y_min, first_row, rows_, columns_);
    while (true) {
      visit(packs_[pack]);
      if (++pack < end) continue;
      // Which border is next is anybody's guess, and g++ makes a branch of every choice between doubles. But such as
      // are not negative have the order of their bits, and of these it is the sign of a difference that tells.
      const auto next_x = std::bit_cast<std::int64_t>(x.next);
      const auto next_y = std::bit_cast<std::int64_t>(y.next);
      const std::int64_t in_x = (next_x - next_y - 1) >> 63;  // -1 for yes, 0 for no
      if (!(std::bit_cast<double>(next_y + ((next_x - next_y) & in_x)) < reach())) return;
      at += static_cast<std::size_t>((x.step & in_x) + (y.step & ~in_x));
      x.cross(in_x);
      y.cross(~in_x);
      pack = begin_[at];
      end = begin_[at + 1];
    }
  }

  /// visitAlong() for many level rays in step: start() brings each to the first pack of its origin's cell, goOn() all
  /// to their next.
  ///@{
  void start(RayWalks& walks) const;
  void goOn(RayWalks& walks) const;
  ///@}

 private:
  /// The way along one axis.
  struct Walk {
    double next = std::numeric_limits<double>::infinity();  ///< distance along the ray to the next border
    double delta = 0;                                       ///< and between borders
    std::int64_t left = 0;                                  ///< borders still to cross before the rim
    std::int64_t step = 0;                                  ///< to the number of the next cell

    /// @param crosses -1 for yes, 0 for no
    void cross(std::int64_t crosses) {
      left += crosses;
      next += std::bit_cast<double>(std::bit_cast<std::int64_t>(delta) & crosses);
      if (left <= 0) next = std::numeric_limits<double>::infinity();
    }
  };
  Walk walk(double origin, double direction, double low, int cell, int count, int stride) const {
    const std::int64_t down = std::bit_cast<std::int64_t>(direction) >> 63;  // -1 for yes, 0 for no
    const double per = 1 / direction;
    const double next = (low + static_cast<double>(cell + 1 + down) * cell_m_ - origin) * per;
    Walk w;
    w.left = (cell & down) | ((count - 1 - cell) & ~down);
    w.step = (stride ^ down) - down;
    w.delta = cell_m_ * std::abs(per);
    w.next = next > 0 ? next : 0.0;
    if (w.left == 0 || std::abs(direction) <= kLeastSlope) w.next = std::numeric_limits<double>::infinity();
    return w;
  }

  std::size_t cellAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  std::span<const Pack> cell(std::size_t at) const {
    return {packs_.data() + begin_[at], packs_.data() + begin_[at + 1]};
  }
  /// Sets the items, by the cell of their centre.
  void sort(std::span<const Solid> solids);
  template <typename Visit>
  void forCells(const GridItem& item, const Visit& visit) const;

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  std::vector<GridItem> items_;          ///< one per solid
  std::vector<RoughSolid> rough_;        ///< one per solid
  std::vector<std::uint32_t> index_of_;  ///< by number
  std::vector<std::uint32_t> count_;     ///< of solids, by cell
  std::vector<std::uint32_t> begin_;     ///< first pack, by cell, and the end
  std::vector<Pack> packs_;              ///< by cell
};

}  // namespace robosim
