#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel_executor.h"
#include "geometry/casting/beams.h"
#include "geometry/shapes/path.h"
#include "geometry/shapes/ray.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Identifies a solid of a Scene: the stationary ones in the order given, then the moving ones.
enum class BodyId : std::uint32_t {};
constexpr BodyId kNoBody{0xffffffffu};

/// Result of a ray query.
struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();
  BodyId body = kNoBody;
  mrpt::math::TPoint3D point;  ///< world frame [m]; undefined without a hit
  explicit operator bool() const { return body != kNoBody; }
};

class GridIndex;    // internal: index/grid_index.h
struct SceneIndex;  // internal: scene_index.h

/// Indexes stationary solids, for scenes that share them. The index never changes, and may be used by several threads.
/// @param area region that the index covers efficiently; solids beyond it are found too
std::shared_ptr<const GridIndex> indexStationary(const std::vector<Solid>& solids, const Bounds2D& area);

/// A solid of either shape in one form.
struct FoundSolid {
  mrpt::math::TPoint2D center;
  mrpt::math::TPoint2D axis{1, 0};  ///< unit vector along a box's length
  double half_length_m = 0;         ///< of a box, or a circle's radius
  double half_width_m = 0;          ///< 0 for a circle
  HeightSpan heights;
  BodyId body = kNoBody;
};

/// All solids of a world at one instant, indexed for ray, sector and proximity queries. Stationary solids are indexed
/// once; freeze() re-indexes the moving ones in linear time without allocating. All queries are const and thread-safe.
///
/// A query may have an owner, such as the robot that carries the sensor: a body that is excluded. If the owner is a
/// moving solid and near the query, its list of neighbours saves the search for stationary solids.
class Scene {
 public:
  /// @param area as of indexStationary()
  Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area);
  /// A scene of stationary solids that other scenes may have as well, at the same time and in other threads.
  Scene(std::shared_ptr<const GridIndex> stationary, std::size_t moving_count);
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// The index of the stationary solids, for another scene.
  const std::shared_ptr<const GridIndex>& stationary() const;
  std::size_t stationaryCount() const { return stationary_count_; }
  std::size_t movingCount() const { return moving_count_; }
  BodyId movingBody(std::size_t i) const { return BodyId(static_cast<std::uint32_t>(stationary_count_ + i)); }
  std::size_t movingIndex(BodyId body) const { return static_cast<std::size_t>(body) - stationary_count_; }
  Solid solid(BodyId body) const;

  /// Sets a moving solid. Takes effect for queries with freeze().
  void place(std::size_t i, const Solid& solid);
  /// Removes a moving solid from all queries, until place(). Takes effect with freeze().
  void remove(std::size_t i);
  void freeze();
  void freeze(const ParallelExecutor& workers);  ///< on several threads
  /// The same for some of the moving solids, each once, in time linear in their number. No query finds the others until
  /// the next freeze.
  void freeze(const ParallelExecutor& workers, std::span<const std::uint32_t> moving);
  /// Updates the neighbours of a moving solid, if necessary: the stationary solids within `reach_m` of its centre, or
  /// the nearest ones if there are very many. May be called for different solids simultaneously.
  void updateNeighbours(std::size_t i, double reach_m);
  /// Number of neighbours of a moving solid: those of updateNeighbours(), and some slightly farther away.
  std::size_t neighbourCount(std::size_t i) const;

  /// The nearest hit strictly nearer than `range_m`. Of equally near bodies the lowest BodyId wins.
  Hit castRay(const Ray&, double range_m, BodyId owner = kNoBody) const;
  /// Casts all beams of a batch: finds for each ray the same as castRay(), for each sector the nearest point of any
  /// solid inside it.
  void cast(BeamBatch& batch, BodyId owner = kNoBody) const;

  /// Reduces path.end_fraction to the first contact of a disc on the path with a stationary solid whose heights overlap
  /// the disc's (swept-disc test; see firstContact()).
  void clip(Path& path, double radius_m, const HeightSpan& heights, BodyId owner = kNoBody) const;
  /// Replaces `found` by those of the first `count` moving solids that are within `reach_m` of a point, each once.
  /// Solids beyond may be found too.
  void findMoving(const mrpt::math::TPoint2D& at, double reach_m, std::size_t count,
                  std::vector<std::uint32_t>& found) const;
  /// Appends the bodies whose bounding rectangle intersects `area`, in ascending order, each once: a superset of those
  /// that overlap it.
  void findBodies(const Bounds2D& area, std::vector<BodyId>& found) const;
  /// The same solids in no particular order, each once.
  void findSolids(const Bounds2D& area, std::vector<FoundSolid>& found) const;

 private:
  std::size_t stationary_count_, moving_count_;
  std::unique_ptr<SceneIndex> index_;
};

}  // namespace robosim
