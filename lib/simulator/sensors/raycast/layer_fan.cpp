#include "sensors/raycast/layer_fan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/portable_math.h"
#include "base/vector_width.h"
#include "sensors/raycast/column_tile.h"

// Functions below are always inlined, so that it does not matter how they pass vectors.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Numbers of a tile's columns.
using Doubles [[gnu::vector_size(sizeof(double) * kLanes), gnu::may_alias]] = double;
using Bits64 [[gnu::vector_size(sizeof(std::int64_t) * kLanes), gnu::may_alias]] = std::int64_t;

/// One layer of a tile.
struct alignas(sizeof(double) * kLanes) LayerOfDepths {
  double depth[kLanes];
};

[[gnu::always_inline]] inline Doubles& vectorOf(LayerOfDepths& layer) {
  return reinterpret_cast<Doubles&>(layer.depth);
}
[[gnu::always_inline]] inline const Doubles& vectorOf(const double* of) {
  return *reinterpret_cast<const Doubles*>(of);
}

/// Cone that contains the directions of a tile.
struct TileCone {
  double x = 1, y = 0;       ///< its axis, a unit vector
  double cos = -1, sin = 0;  ///< of its half angle; all directions if it is not acute

  [[gnu::always_inline]] TileCone(const double* dx, const double* dy) : x(dx[kLanes / 2]), y(dy[kLanes / 2]) {
    double least = 1;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double along = dx[i] * x + dy[i] * y;
      least = along < least ? along : least;
    }
    constexpr double kSlack = 1e-9;
    cos = least - kSlack;
    sin = std::sqrt(std::max(0.0, 1 - cos * cos));
  }
  /// Whether a disc may reach into it. Conservative: no false negatives.
  [[gnu::always_inline]] bool mayContain(double disc_x, double disc_y, double radius_m) const {
    const double along = disc_x * x + disc_y * y;
    const double across = std::abs(disc_y * x - disc_x * y);
    return cos <= 0.1 || ((across * cos - along * sin <= radius_m) & (along >= -radius_m));
  }
};

}  // namespace

struct LayerFan::Job {
  const LayerFan* fan;
  const double *dx, *dy, *x, *y;  ///< of all columns; x and y of moved ones only
  double spread_m;
  double floor_m;  ///< height of the floor relative to the origin; -infinity when it is not seen
  const std::vector<SeenSolid>* solids;
  LayerOfDepths* depths;       ///< by layer
  const double* background_m;  ///< by layer: depth of the floor or of the range
  double* distance_m;
};

LayerFan::LayerFan(std::span<const TPoint2D> directions, std::span<const double> elevations_rad, double range_max_m)
    : columns_(directions.size()), range_m_(range_max_m) {
  const std::size_t padded = (columns_ + kLanes - 1) / kLanes * kLanes;
  for (std::size_t i = 0; i < padded; ++i) {
    const TPoint2D& direction = directions[std::min(i, columns_ - 1)];
    dx_.push_back(direction.x);
    dy_.push_back(direction.y);
  }
  ones_.assign(padded, 1);
  for (const double elevation_rad : elevations_rad) {
    const auto [sin, cos] = portable::sincos(elevation_rad);
    assert(cos > 0);
    slope_.push_back(sin / cos);
    per_slope_.push_back(cos / sin);  // infinite for a level layer
    level_.push_back(cos);
    per_level_.push_back(1 / cos);
  }
}

template <bool kIsMoved>
[[gnu::always_inline]] inline void LayerFan::castTiles(const Job* the_job) {
  const Job& job = *the_job;
  const LayerFan& fan = *job.fan;
  const std::size_t layers = fan.layers();
  const double* const slopes = fan.slope_.data();
  const double* const per_slopes = fan.per_slope_.data();
  const double* const per_level = fan.per_level_.data();
  Horizon horizon;
  Crossing crossing;
  VisibleSpan span;
  for (std::size_t first = 0; first < fan.columns_; first += kLanes) {
    for (std::size_t layer = 0; layer < layers; ++layer)
      vectorOf(job.depths[layer]) = Doubles{} + job.background_m[layer];
    horizon.reset();
    const TileColumns columns{job.dx + first,
                              job.dy + first,
                              fan.ones_.data(),
                              fan.ones_.data(),
                              kIsMoved ? job.x + first : nullptr,
                              kIsMoved ? job.y + first : nullptr};
    const TileCone cone(columns.dx, columns.dy);
    for (const SeenSolid& s : *job.solids) {
      if (!cone.mayContain(s.x, s.y, s.half_length_m + s.half_width_m + job.spread_m) || isHidden(s, horizon)) continue;
      if (s.isCircle()) {
        crossCircle<kIsMoved>(columns, s, 0, 0, crossing);
      } else {
        crossBox<kIsMoved>(columns, s, crossing);
      }
      if (!clipToHorizon(s, crossing, job.floor_m, horizon, span)) continue;
      const Doubles in = vectorOf(span.in), out = vectorOf(span.out), low = vectorOf(span.low),
                    high = vectorOf(span.high);
      std::size_t begin = 0, end = 0;
      for (std::size_t layer = 0; layer < layers; ++layer) {
        begin += slopes[layer] < span.low_min ? 1 : 0;
        end += slopes[layer] <= span.high_max ? 1 : 0;
      }
      for (std::size_t layer = begin; layer < end; ++layer) {
        Doubles& depth = vectorOf(job.depths[layer]);
        const double slope = slopes[layer];
        const Bits64 is_seen = (slope >= low) & (slope <= high) & (in < depth);
        depth = is_seen ? in : depth;
      }
      if (span.level_m == 0) continue;
      for (std::size_t layer = 0; layer < layers; ++layer) {
        Doubles& depth = vectorOf(job.depths[layer]);
        const double at = span.level_m * per_slopes[layer];
        const Bits64 is_seen = (at >= in) & (at <= out) & (at < depth);
        depth = is_seen ? Doubles{} + at : depth;
      }
    }
    const std::size_t count = std::min(kLanes, fan.columns_ - first);
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const Doubles& depth = vectorOf(job.depths[layer]);
      const Bits64 is_hit = depth < fan.range_m_ * fan.level_[layer];
      LayerOfDepths found;
      vectorOf(found) = is_hit ? depth * per_level[layer] : Doubles{} + kInfinity;
      double* const to = job.distance_m + layer * fan.columns_ + first;
      if (count == kLanes) {
        std::memcpy(to, found.depth, sizeof found.depth);
      } else {
        std::memcpy(to, found.depth, sizeof(double) * count);
      }
    }
  }
}

namespace {

/// Memory for scans, reused for all scanners of a thread.
struct ScanScratch {
  std::vector<SeenSolid> solids;
  std::vector<LayerOfDepths> depths;
  std::vector<double> background_m, dx, dy, x, y;
};

ScanScratch& scanScratch() {
  static thread_local ScanScratch scratch;
  return scratch;
}

}  // namespace

void LayerFan::cast(const Scene& scene, const ViewFrame& frame, BodyId owner, std::span<double> distance_m) const {
  castMoved(scene, frame, {}, 0, owner, distance_m);
}

void LayerFan::castMoved(const Scene& scene, const ViewFrame& frame, std::span<const Column> moved, double spread_m,
                         BodyId owner, std::span<double> distance_m) const {
  assert(distance_m.size() == columns() * layers());
  constexpr double kSlack_m = 1e-9;
  ScanScratch& scratch = scanScratch();
  Job job{.fan = this,
          .dx = dx_.data(),
          .dy = dy_.data(),
          .x = nullptr,
          .y = nullptr,
          .spread_m = spread_m + kSlack_m,
          .floor_m = frame.z > 0 ? -frame.z : -kInfinity,
          .solids = &scratch.solids,
          .depths = nullptr,
          .background_m = nullptr,
          .distance_m = distance_m.data()};
  if (!moved.empty()) {
    for (auto* of : {&scratch.dx, &scratch.dy, &scratch.x, &scratch.y}) of->resize(dx_.size());
    for (std::size_t i = 0; i < dx_.size(); ++i) {
      const Column& column = moved[std::min(i, columns_ - 1)];
      scratch.dx[i] = column.direction.x;
      scratch.dy[i] = column.direction.y;
      scratch.x[i] = column.origin.x;
      scratch.y[i] = column.origin.y;
    }
    job.dx = scratch.dx.data();
    job.dy = scratch.dy.data();
    job.x = scratch.x.data();
    job.y = scratch.y.data();
  }
  findSeenSolids(scene, frame, {.range_m = range_m_, .spread_m = job.spread_m}, owner, scratch.solids);
  scratch.depths.resize(layers());
  scratch.background_m.clear();
  for (std::size_t layer = 0; layer < layers(); ++layer) {
    const double floor_m = slope_[layer] < 0 && job.floor_m < 0 ? job.floor_m * per_slope_[layer] : kInfinity;
    scratch.background_m.push_back(std::min(floor_m, range_m_ * level_[layer]));
  }
  job.depths = scratch.depths.data();
  job.background_m = scratch.background_m.data();
  const auto* const the_job = static_cast<const Job*>(&job);
  if (moved.empty()) {
    withVectors<castTiles<false>>(the_job);
  } else {
    withVectors<castTiles<true>>(the_job);
  }
}

}  // namespace robosim
