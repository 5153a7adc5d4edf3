#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/casting/beam_batch.h"
#include "geometry/index/center_index.h"
#include "geometry/index/culling.h"
#include "geometry/index/grid_index.h"
#include "geometry/index/neighbour_list.h"
#include "geometry/shapes/path.h"
#include "geometry/shapes/ray.h"
#include "geometry/shapes/sector.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Identifies a solid of a Scene: the stationary ones in the order given, then the moving ones.
enum class BodyId : std::uint32_t {};
constexpr BodyId kNoBody{0xffffffffu};

/// Result of a ray or sector query.
struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();
  BodyId body = kNoBody;
  mrpt::math::TPoint3D point;  ///< world frame [m]; undefined without a hit
  explicit operator bool() const { return body != kNoBody; }
};

struct ClosestHit;

/// All solids of a world at one instant, indexed for ray, sector and proximity queries. Stationary solids are indexed
/// once; freeze() re-indexes the moving ones in linear time without allocating. All queries are const and thread-safe.
/// A query may exclude one body, such as the robot that owns the sensor.
class Scene {
 public:
  /// @param area region that the index covers efficiently; solids beyond it are found too
  Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area);

  std::size_t stationaryCount() const { return stationary_index_.items().size(); }
  std::size_t movingCount() const { return moving_index_.items().size(); }
  BodyId movingBody(std::size_t i) const { return BodyId(static_cast<std::uint32_t>(stationaryCount() + i)); }
  /// @param index as in a NeighbourList
  BodyId stationaryBody(std::uint32_t index) const { return BodyId{stationary_index_.items()[index].number}; }
  std::size_t movingIndex(BodyId body) const { return static_cast<std::size_t>(body) - stationaryCount(); }
  Solid solid(BodyId body) const;

  /// Sets a moving solid. Takes effect for queries with freeze().
  void place(std::size_t i, const Solid& solid) { moving_index_.set(i, solid); }
  void freeze() { moving_index_.build(); }

  /// The nearest hit strictly nearer than `range_m`. Of equally near bodies the lowest BodyId wins.
  Hit castRay(const Ray&, double range_m, BodyId except = kNoBody) const;
  /// The nearest point of any solid inside the sector strictly nearer than `range_m`. Of equally near bodies the lowest
  /// BodyId wins.
  Hit senseSector(const Sector&, double range_m, BodyId except = kNoBody) const;

  /// Casts all beams of a batch; equivalent to castRay() or senseSector() for each. A non-empty `near` saves the search
  /// for stationary solids.
  void cast(BeamBatch& batch, BodyId except = kNoBody, const NeighbourList& near = {}) const;

  /// Updates the list, if necessary, so that it covers the stationary solids within `reach_m` of a point, or the
  /// nearest ones if there are very many.
  void update(NeighbourList& near, const mrpt::math::TPoint2D& at, double reach_m) const;

  /// Calls visit(solid) for every stationary solid within `reach_m` of a point, in no particular order. A solid may be
  /// visited more than once, and solids beyond `reach_m` may be visited.
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
  /// Calls visit(body) once for every moving solid within `reach_m` of a point. Solids beyond may be visited too.
  template <typename Visit>
  void visitMoving(const mrpt::math::TPoint2D& at, double reach_m, const Visit& visit) const {
    const RangeCull near(at, reach_m, moving_index_.middle());
    moving_index_.visitNear(near.bounds(), [&](const CenterIndex::Entry& entry) {
      if (near.mayContain(entry.solid)) visit(movingBody(entry.index));
    });
  }

  /// Appends the bodies whose bounding rectangle intersects `area`, in ascending order, each once: a superset of those
  /// that overlap it.
  void stationaryNear(const Bounds2D& area, std::vector<BodyId>& found) const;
  void movingNear(const Bounds2D& area, std::vector<BodyId>& found) const;

 private:
  /// castRay(), compiled for each vector width.
  struct RayCaster;
  /// castRay() without restrictions: for rays that are not planar or leave the grid's interior.
  Hit castAnyRay(const Ray&, double range_m, BodyId except) const;
  /// The given hit, or a nearer one of a planar ray among the moving solids.
  Hit castAmongMoving(const Ray& ray, BodyId except, ClosestHit best) const;
  /// Visits the solids of all cells that intersect an area. A solid listed in several cells is visited several times.
  template <typename Visit>
  void forCells(const Bounds2D& area, const Visit& visit) const;

  GridIndex stationary_index_;
  CenterIndex moving_index_;
};

}  // namespace robosim
