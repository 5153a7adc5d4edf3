#include "robots/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/portable_math.h"
#include "base/random.h"
#include "geometry/scene.h"
#include "robots/free_space.h"
#include "robots/robot_model_cache.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Consecutive random places that may be occupied before an area counts as full.
constexpr int kMaxTries = 1000;
/// Maximum number of places examined in one grid or ring.
constexpr std::size_t kMaxSites = 1'000'000;

/// Upright discs, indexed by a hash grid of their centres.
class Discs {
 public:
  /// @param max_radius_m of the discs @param gap_m usual gap between them
  Discs(double max_radius_m, double gap_m)
      : max_radius_m_(max_radius_m), cell_m_(std::max(2 * max_radius_m + gap_m, 1e-3)) {}

  void add(const Circle& disc, const HeightSpan& heights) {
    const auto index = static_cast<std::uint32_t>(discs_.size());
    const auto [head, is_new] = first_.try_emplace(key(cell(disc.center.x), cell(disc.center.y)), index);
    discs_.push_back({disc, heights, is_new ? kNone : std::exchange(head->second, index)});
  }

  /// Whether no disc overlaps this one.
  bool isClear(const Circle& disc, const HeightSpan& heights) const {
    const auto overlaps = [&](const Entry& other) {
      const double apart_m = other.disc.radius_m + disc.radius_m;
      return (other.disc.center - disc.center).sqrNorm() < apart_m * apart_m && other.heights.overlaps(heights);
    };
    const double reach_m = disc.radius_m + max_radius_m_;
    const double cells_across = 2 * reach_m / cell_m_ + 1;
    if (cells_across * cells_across > static_cast<double>(discs_.size())) {
      return std::none_of(discs_.begin(), discs_.end(), overlaps);
    }
    for (auto row = cell(disc.center.y - reach_m); row <= cell(disc.center.y + reach_m); ++row) {
      for (auto column = cell(disc.center.x - reach_m); column <= cell(disc.center.x + reach_m); ++column) {
        const auto head = first_.find(key(column, row));
        if (head == first_.end()) continue;
        for (std::uint32_t i = head->second; i != kNone; i = discs_[i].next) {
          if (overlaps(discs_[i])) return false;
        }
      }
    }
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Entry {
    Circle disc;
    HeightSpan heights;
    std::uint32_t next;  ///< in the same cell
  };
  std::int64_t cell(double at_m) const { return static_cast<std::int64_t>(std::floor(at_m / cell_m_)); }
  /// Hash collisions cost a comparison, but do not affect the result.
  static std::uint64_t key(std::int64_t column, std::int64_t row) {
    return static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(row);
  }

  double max_radius_m_, cell_m_;
  std::vector<Entry> discs_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;  ///< by cell: its last disc
};

/// What is copied, as a disc.
struct Copied {
  double radius_m = 0;
  HeightSpan heights;
};

/// Finds the places of one scatter after another.
class Scatterer {
 public:
  Scatterer(World& world, const std::string& world_file, const RobotTypes& types, std::uint64_t seed, ErrorList& errors)
      : world_(world),
        world_file_(world_file),
        types_(types),
        seed_(seed),
        errors_(errors),
        solids_(startSolids(world)),
        scene_(solids_, 0, world.bounds) {
    scene_.freeze();
    addPlacedRobots();
  }

  void place(std::uint32_t index, const Scatter& scatter) {
    const std::size_t faults = errors_.count();
    const Copied copied = copiedBy(scatter);
    if (errors_.count() > faults) return;
    Rng rng(seed_, RandomPurpose::scenery, 1, index);
    std::vector<TPoint2D> places;
    try {
      places = placesFor(scatter, copied, rng);
    } catch (const ConfigError& error) {
      report(scatter, error.what());
      return;
    }
    if (places.size() < static_cast<std::size_t>(scatter.count)) {
      report(scatter, "there is room for " + std::to_string(places.size()) + " of " + std::to_string(scatter.count) +
                          " only; use a smaller count or gap, or " +
                          (scatter.pattern == ScatterPattern::ring ? "a larger radius" : "a larger area"));
      return;
    }
    Discs discs(copied.radius_m, scatter.gap_m);
    for (int i = 0; i < scatter.count; ++i) {
      const TPoint2D& at = places[static_cast<std::size_t>(i)];
      const double heading =
          scatter.direction_rad ? *scatter.direction_rad : rng.uniform(-std::numbers::pi, std::numbers::pi);
      discs.add({at, copied.radius_m}, copied.heights);
      addCopy(scatter, i + 1, {at.x, at.y, heading});
    }
    taken_.push_back(std::move(discs));
  }

 private:
  void report(const Scatter& scatter, const std::string& what) {
    errors_.add(world_.fileOf(scatter.line, world_file_), scatter.line.number, "<scatter>: " + what);
  }

  /// Faults of these robots' models are reported by buildFleet().
  void addPlacedRobots() {
    ErrorList ignored;
    RobotModelCache models(world_, world_file_, types_, ignored);
    std::vector<std::pair<Circle, HeightSpan>> robots;
    double max_radius_m = 0;
    for (const auto& robot : world_.robots) {
      const auto model = models.modelFor(robot);
      if (!model) continue;
      robots.push_back({{{robot.world_from_robot.x, robot.world_from_robot.y}, model->radius_m},
                        robot.body.value_or(model->body).heights()});
      max_radius_m = std::max(max_radius_m, model->radius_m);
    }
    Discs discs(max_radius_m, 0);
    for (const auto& [disc, heights] : robots) discs.add(disc, heights);
    taken_.push_back(std::move(discs));
  }

  Copied copiedBy(const Scatter& scatter) {
    if (const auto* object = std::get_if<WorldObject>(&scatter.copied)) {
      return {object->body.coveringRadius(), object->body.heights()};
    }
    const auto& robot = std::get<RobotPlacement>(scatter.copied);
    RobotModelCache models(world_, world_file_, types_, errors_);
    const auto model = models.modelFor(robot);
    if (!model) return {};
    return {model->radius_m, robot.body.value_or(model->body).heights()};
  }

  void addCopy(const Scatter& scatter, int number, const mrpt::math::TPose2D& pose) {
    if (const auto* object = std::get_if<WorldObject>(&scatter.copied)) {
      WorldObject& copy = world_.objects.emplace_back(*object);
      copy.name = scatter.nameOf(number);
      copy.body.world_from_body = pose;
      if (copy.walker) copy.walker->home = {pose.x, pose.y};
      return;
    }
    RobotPlacement& copy = world_.robots.emplace_back(std::get<RobotPlacement>(scatter.copied));
    copy.name = scatter.nameOf(number);
    copy.neighbour = scatter.neighbourOf(number);
    copy.world_from_robot = pose;
    if (copy.body) copy.body->world_from_body = pose;
  }

  /// Up to `count` places; fewer when there is no room.
  std::vector<TPoint2D> placesFor(const Scatter& scatter, const Copied& copied, Rng& rng) {
    switch (scatter.pattern) {
      case ScatterPattern::uniform:
        return uniformPlaces(scatter, copied, rng);
      case ScatterPattern::free:
        return freePlaces(scatter, copied, rng);
      case ScatterPattern::grid:
        return gridPlaces(scatter, copied);
      case ScatterPattern::ring:
        return ringPlaces(scatter, copied);
    }
    return {};
  }

  /// Region of the centres: the area and the surface, less a disc's radius; its sides are negative when it is too
  /// narrow.
  Bounds2D computeRegion(const Scatter& scatter, const Copied& copied) const {
    const double radius_m = copied.radius_m + kContactGap_m;  // so that rounding never places a disc beyond the edge
    const Bounds2D& surface = world_.bounds;
    const Bounds2D area = scatter.area.value_or(surface);
    return {std::max(area.x_min, surface.x_min) + radius_m, std::min(area.x_max, surface.x_max) - radius_m,
            std::max(area.y_min, surface.y_min) + radius_m, std::min(area.y_max, surface.y_max) - radius_m};
  }
  static bool isEmpty(const Bounds2D& region) { return region.x_min > region.x_max || region.y_min > region.y_max; }

  /// Whether a copy at this place keeps its gap to everything except copies of its own scatter.
  bool isClear(const TPoint2D& at, const Scatter& scatter, const Copied& copied) {
    const double clearance_m = copied.radius_m + scatter.gap_m + kContactGap_m;
    const auto& surface = world_.bounds;
    if (at.x - copied.radius_m < surface.x_min || at.x + copied.radius_m > surface.x_max ||
        at.y - copied.radius_m < surface.y_min || at.y + copied.radius_m > surface.y_max) {
      return false;
    }
    const Circle disc{at, clearance_m};
    for (const auto& discs : taken_) {
      if (!discs.isClear(disc, copied.heights)) return false;
    }
    near_.clear();
    scene_.findBodies(boundsOf(disc), near_);
    return std::none_of(near_.begin(), near_.end(), [&](BodyId body) {
      const Solid& solid = solids_[static_cast<std::size_t>(body)];
      return solid.heights.overlaps(copied.heights) && distance(solid.outline, at) < clearance_m;
    });
  }

  std::vector<TPoint2D> uniformPlaces(const Scatter& scatter, const Copied& copied, Rng& rng) {
    const Bounds2D region = computeRegion(scatter, copied);
    std::vector<TPoint2D> places;
    if (isEmpty(region)) return places;
    Discs own(copied.radius_m, scatter.gap_m);
    const double clearance_m = copied.radius_m + scatter.gap_m + kContactGap_m;
    for (int tries = 0; tries < kMaxTries && places.size() < static_cast<std::size_t>(scatter.count); ++tries) {
      const double x = rng.uniform(region.x_min, region.x_max);
      const TPoint2D at{x, rng.uniform(region.y_min, region.y_max)};
      if (!own.isClear({at, clearance_m}, copied.heights) || !isClear(at, scatter, copied)) continue;
      own.add({at, copied.radius_m}, copied.heights);
      places.push_back(at);
      tries = -1;
    }
    return places;
  }

  std::vector<TPoint2D> freePlaces(const Scatter& scatter, const Copied& copied, Rng& rng) {
    const Bounds2D region = computeRegion(scatter, copied);
    FreeSpace free(world_, copied.radius_m, copied.heights);
    free.blockUnknown(world_);
    free.blockOutside(region);
    std::vector<TPoint2D> candidates;
    for (const std::size_t cell : free.largestRegion()) candidates.push_back(free.place(cell));
    Discs own(copied.radius_m, scatter.gap_m);
    const double clearance_m = copied.radius_m + scatter.gap_m + kContactGap_m;
    std::vector<TPoint2D> places;
    while (!candidates.empty() && places.size() < static_cast<std::size_t>(scatter.count)) {
      const std::size_t draw = rng.below(static_cast<std::uint32_t>(candidates.size()));
      const TPoint2D at = std::exchange(candidates[draw], candidates.back());
      candidates.pop_back();
      if (!own.isClear({at, clearance_m}, copied.heights) || !isClear(at, scatter, copied)) continue;
      own.add({at, copied.radius_m}, copied.heights);
      places.push_back(at);
    }
    return places;
  }

  /// Rows and columns, first as far apart as `count` points can be, then closer until enough points are clear.
  std::vector<TPoint2D> gridPlaces(const Scatter& scatter, const Copied& copied) {
    const Bounds2D region = computeRegion(scatter, copied);
    std::vector<TPoint2D> best;
    if (isEmpty(region)) return best;
    const double width_m = region.x_max - region.x_min, length_m = region.y_max - region.y_min;
    const double least_m = 2 * copied.radius_m + scatter.gap_m + kContactGap_m;
    // The tolerance makes a pitch of width_m / n give n + 1 columns in spite of rounding.
    const auto along = [](double extent_m, double pitch_m) { return std::floor(extent_m / pitch_m + 1e-9) + 1; };
    double pitch_m = std::max({width_m, length_m, least_m});
    for (bool is_last = false; !is_last;) {
      const double columns = along(width_m, pitch_m), rows = along(length_m, pitch_m);
      if (columns * rows > static_cast<double>(kMaxSites)) break;
      const bool is_dense = columns * rows >= scatter.count;
      is_last = pitch_m <= least_m;
      if (is_dense || is_last) {
        std::vector<TPoint2D> places;
        const double left = (region.x_min + region.x_max - (columns - 1) * pitch_m) / 2;
        const double bottom = (region.y_min + region.y_max - (rows - 1) * pitch_m) / 2;
        for (double row = 0; row < rows; ++row) {
          for (double column = 0; column < columns && places.size() < static_cast<std::size_t>(scatter.count);
               ++column) {
            const TPoint2D at{left + column * pitch_m, bottom + row * pitch_m};
            if (isClear(at, scatter, copied)) places.push_back(at);
          }
        }
        if (places.size() > best.size()) best = std::move(places);
        if (best.size() == static_cast<std::size_t>(scatter.count)) break;
      }
      // Until there are enough points: the next smaller pitch that adds a column or a row.
      pitch_m = std::max(least_m, is_dense ? pitch_m * 0.95 : std::max(width_m / columns, length_m / rows));
    }
    return best;
  }

  /// Points on the circle, first `count`, then more until enough are clear.
  std::vector<TPoint2D> ringPlaces(const Scatter& scatter, const Copied& copied) {
    const double least_m = 2 * copied.radius_m + scatter.gap_m + kContactGap_m;
    const auto fits = [&](std::size_t points) {
      const double half_angle = std::numbers::pi / static_cast<double>(points);
      return points == 1 || 2 * scatter.ring_radius_m * portable::sin(half_angle) >= least_m;
    };
    std::size_t most = 1;
    for (std::size_t step = kMaxSites / 2; step > 0; step = (step + (step > 1 ? 1 : 0)) / 2) {
      while (most + step <= kMaxSites && fits(most + step)) most += step;
    }
    std::vector<TPoint2D> best;
    for (std::size_t points = std::min(most, static_cast<std::size_t>(scatter.count));;) {
      std::vector<TPoint2D> places;
      for (std::size_t i = 0; i < points && places.size() < static_cast<std::size_t>(scatter.count); ++i) {
        const auto direction =
            portable::sincos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points));
        const TPoint2D at{scatter.ring_center.x + scatter.ring_radius_m * direction.cos,
                          scatter.ring_center.y + scatter.ring_radius_m * direction.sin};
        if (isClear(at, scatter, copied)) places.push_back(at);
      }
      if (places.size() > best.size()) best = std::move(places);
      if (best.size() == static_cast<std::size_t>(scatter.count) || points == most) break;
      points = std::min(most, points + 1 + points / 20);
    }
    return best;
  }

  World& world_;
  const std::string& world_file_;
  const RobotTypes& types_;
  std::uint64_t seed_;
  ErrorList& errors_;
  std::vector<Solid> solids_;
  Scene scene_;
  std::vector<Discs> taken_;  ///< the placed robots, then the copies of each scatter
  std::vector<BodyId> near_;  ///< reused
};

}  // namespace

void placeScattered(World& world, const std::string& world_file, const RobotTypes& types, std::uint64_t seed,
                    ErrorList& errors) {
  if (world.scatters.empty() || !errors.empty()) return;
  const std::vector<Scatter> scatters = std::exchange(world.scatters, {});
  world.origin.is_scattered = true;
  Scatterer scatterer(world, world_file, types, seed, errors);
  for (std::size_t i = 0; i < scatters.size(); ++i) scatterer.place(static_cast<std::uint32_t>(i), scatters[i]);
}

}  // namespace robosim
