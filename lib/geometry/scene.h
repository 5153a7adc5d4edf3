#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/candidates.h"
#include "geometry/center_index.h"
#include "geometry/grid_index.h"
#include "geometry/near.h"
#include "geometry/neighbour_list.h"
#include "geometry/path.h"
#include "geometry/ray.h"
#include "geometry/ray_batch.h"
#include "geometry/sector.h"
#include "geometry/sector_batch.h"
#include "geometry/solid.h"

namespace robosim {

/// A solid of a Scene: first the stationary ones in the order given, then the moving ones.
enum class BodyId : std::uint32_t {};
constexpr BodyId kNoBody{0xffffffffu};

/// What a ray or a sector met.
struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();
  BodyId body = kNoBody;
  mrpt::math::TPoint3D point;  ///< world frame [m]; undefined when nothing was met
  explicit operator bool() const { return body != kNoBody; }
};

struct NearestSoFar;

/// All solids of a world at one moment, indexed for fast questions. The stationary ones are indexed once; after the
/// moving ones have moved, freeze() indexes those again, in linear time and without allocating. Every question is const
/// and may be asked from any number of threads. A body may be left out of a question: the one who asks.
class Scene {
 public:
  /// @param area the part of the plane that the index covers well; solids beyond it are found too.
  Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area);

  std::size_t stationaryCount() const { return stationary_index_.items().size(); }
  std::size_t movingCount() const { return moving_index_.items().size(); }
  BodyId movingBody(std::size_t i) const { return BodyId(static_cast<std::uint32_t>(stationaryCount() + i)); }
  /// @param index as in a NeighbourList
  BodyId stationaryBody(std::uint32_t index) const { return BodyId{stationary_index_.items()[index].number}; }
  std::size_t movingIndex(BodyId body) const { return static_cast<std::size_t>(body) - stationaryCount(); }
  Solid solid(BodyId body) const;

  /// Sets where a moving solid is; takes effect for questions with freeze().
  void place(std::size_t i, const Solid& solid) { moving_index_.set(i, solid); }
  void freeze() { moving_index_.build(); }

  /// The nearest solid that the ray meets strictly nearer than `range_m`. A tie goes to the lowest BodyId.
  Hit castRay(const Ray&, double range_m, BodyId except = kNoBody) const;
  /// The nearest point of any solid inside the sector strictly nearer than `range_m`. A tie goes to the lowest BodyId.
  Hit senseSector(const Sector&, double range_m, BodyId except = kNoBody) const;

  /// Casts all rays of a batch, as castRay() would one by one. `near`, where its owner has one, saves the search.
  void castRays(RayBatch& batch, BodyId except = kNoBody, const NeighbourList& near = {}) const;

  /// Asks all sectors of a batch, as senseSector() would one by one.
  void senseSectors(SectorBatch& batch, BodyId except = kNoBody, const NeighbourList& near = {}) const;

  /// Sees to it that the list holds the stationary solids within `reach_m` of a point (the nearest ones, where there
  /// are very many).
  void update(NeighbourList& near, const mrpt::math::TPoint2D& at, double reach_m) const;

  /// Calls visit(solid) for every stationary solid within `reach_m` of a point, in no order, maybe more than once, and
  /// maybe for some beyond.
  template <typename Visit>
  void visitStationary(const mrpt::math::TPoint2D& at, double reach_m, const NeighbourList& near,
                       const Visit& visit) const {
    const auto reach = [&] { return reach_m; };
    if (near.visitNear(at, reach, [&](std::uint32_t i) { visit(stationary_index_.items()[i].solid()); })) return;
    static thread_local std::vector<BodyId> found;
    found.clear();
    stationaryNear({at.x - reach_m, at.x + reach_m, at.y - reach_m, at.y + reach_m}, found);
    for (const BodyId body : found) visit(solid(body));
  }
  /// Calls visit(body) for every moving solid within `reach_m` of a point, each once, and maybe for some beyond.
  template <typename Visit>
  void visitMoving(const mrpt::math::TPoint2D& at, double reach_m, const Visit& visit) const {
    const Near near(at, reach_m, moving_index_.middle());
    moving_index_.visitNear(near.bounds(), [&](const CenterIndex::Entry& entry) {
      if (near.mayHold(entry.solid)) visit(movingBody(entry.index));
    });
  }

  /// Appends the bodies near `area`, in ascending order, each once: all that reach into it, and none whose bounding
  /// rectangle lies beyond it.
  void stationaryNear(const Bounds2D& area, std::vector<BodyId>& found) const;
  void movingNear(const Bounds2D& area, std::vector<BodyId>& found) const;

 private:
  /// castRay() for any ray: one that is not level, or is not among what the grid holds.
  Hit castAnyRay(const Ray&, double range_m, BodyId except) const;
  /// The best so far, or a moving solid that a level ray meets nearer.
  Hit castAmongMoving(const Ray& ray, BodyId except, NearestSoFar best) const;
  /// Holds every body that may matter against a batch, the nearest first.
  template <typename Batch>
  void meetAll(Batch& batch, BodyId except, const NeighbourList& near) const;

  /// Visits what the cells that meet an area list; what lies in several of them, several times.
  template <typename Visit>
  void forCells(const Bounds2D& area, const Visit& visit) const;

  GridIndex stationary_index_;
  CenterIndex moving_index_;
};

}  // namespace robosim
