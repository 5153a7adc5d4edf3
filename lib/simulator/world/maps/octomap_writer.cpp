#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#define OCTOMAP_NODEBUGOUT  // otherwise it logs to standard error
#include <octomap/OcTree.h>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "world/maps/map_writer.h"

namespace robosim {
namespace {

/// Minimum overlap [m] with a voxel: rounding may put faces that touch a border on either side of it.
constexpr double kTouch_m = 1e-7;
constexpr unsigned kDepth = 16;          ///< depth of every octomap::OcTree
constexpr double kVoxelsToEdge = 32768;  ///< distance from the origin in voxels

/// Axis-aligned cuboid.
struct Cuboid {
  Bounds2D plan;
  HeightSpan heights;

  static Cuboid around(const Solid& solid) { return {boundsOf(solid.outline), solid.heights}; }
  bool overlaps(const Cuboid& other) const {
    return plan.x_min < other.plan.x_max && other.plan.x_min < plan.x_max && plan.y_min < other.plan.y_max &&
           other.plan.y_min < plan.y_max && heights.overlaps(other.heights);
  }
  bool contains(const Cuboid& other) const {
    return plan.covers(other.plan) && heights.contains(other.heights.z_min_m) &&
           heights.contains(other.heights.z_max_m);
  }
  Cuboid shrunk(double by_m) const {
    return {{plan.x_min + by_m, plan.x_max - by_m, plan.y_min + by_m, plan.y_max - by_m},
            {heights.z_min_m + by_m, heights.z_max_m - by_m}};
  }
  Solid solid() const {
    return {OrientedBox{{(plan.x_min + plan.x_max) / 2, (plan.y_min + plan.y_max) / 2},
                        {1, 0},
                        (plan.x_max - plan.x_min) / 2,
                        (plan.y_max - plan.y_min) / 2},
            heights};
  }
  /// Surface area [m²].
  double surface() const {
    const double x = plan.x_max - plan.x_min, y = plan.y_max - plan.y_min, z = heights.z_max_m - heights.z_min_m;
    return 2 * (x * y + y * z + z * x);
  }
  /// Volume [m³] of the intersection with another cuboid.
  double sharedVolume(const Cuboid& other) const {
    const auto shared = [](double a1, double a2, double b1, double b2) {
      return std::max(0.0, std::min(a2, b2) - std::max(a1, b1));
    };
    return shared(plan.x_min, plan.x_max, other.plan.x_min, other.plan.x_max) *
           shared(plan.y_min, plan.y_max, other.plan.y_min, other.plan.y_max) *
           shared(heights.z_min_m, heights.z_max_m, other.heights.z_min_m, other.heights.z_max_m);
  }
};

/// Lower corner of a cube, in voxels from the lowest corner of a tree.
using Corner = std::array<std::uint32_t, 3>;

/// OcTree that accepts leaves at any depth, so that large uniform cubes are not made of voxels.
class Tree : public octomap::OcTree {
 public:
  explicit Tree(double voxel_m) : OcTree(voxel_m) {
    root = new octomap::OcTreeNode;
    tree_size = 1;
    size_changed = true;
  }

  void put(const Corner& corner, unsigned depth, float log_odds) {
    octomap::OcTreeNode* node = root;
    for (unsigned level = 0; level < depth; ++level) {
      unsigned child = 0;
      for (unsigned axis = 0; axis < 3; ++axis) child |= (corner[axis] >> (kDepth - 1 - level) & 1) << axis;
      node = nodeChildExists(node, child) ? getNodeChild(node, child) : createNodeChild(node, child);
    }
    node->setLogOdds(log_odds);
  }
};

class OctomapBuilder {
 public:
  OctomapBuilder(const World& world, const MapExtent& extent, const std::function<void(double)>& progress)
      : voxel_m_(extent.cell_m),
        tree_(extent.cell_m),
        space_{world.bounds, extent.heights},
        progress_(progress),
        volume_m3_(space_.sharedVolume(space_)) {
    for (const auto& solid : startSolids(world)) {
      if (!solid.heights.overlaps(extent.heights)) continue;
      obstacles_.push_back({solid, Cuboid::around(solid)});
    }
    const double edge_m = kVoxelsToEdge * voxel_m_;
    const Cuboid all{{-edge_m, edge_m, -edge_m, edge_m}, {-edge_m, edge_m}};
    const auto check = [&](const Cuboid& cuboid) {
      if (all.contains(cuboid)) return;
      throw ConfigError("an OctoMap of " + toText(voxel_m_) + " m voxels reaches " + toText(edge_m) +
                        " m from the origin, and the world reaches further; make them larger, or move the world");
    };
    check(space_);
    for (const auto& obstacle : obstacles_) check(obstacle.around);
    checkVoxelCount();
  }

  std::string write(OctomapForm form) {
    std::vector<std::uint32_t> all_obstacles(obstacles_.size());
    for (std::uint32_t i = 0; i < all_obstacles.size(); ++i) all_obstacles[i] = i;
    fill({0, 0, 0}, 0, all_obstacles);
    tree_.updateInnerOccupancy();
    tree_.prune();
    std::ostringstream out;
    if (form == OctomapForm::probabilities) {
      tree_.write(out);
    } else {
      // Equivalent to writeBinary(), which would log to standard error.
      out << "# Octomap OcTree binary file\n#\nid OcTree\nsize " << tree_.size() << "\nres " << toText(voxel_m_)
          << "\ndata\n";
      tree_.writeBinaryData(out);
    }
    return out.str();
  }

 private:
  /// Rejects a tree that would be too large: single voxels occur at the surfaces of solids only; their interiors and
  /// the free space consist of larger cubes.
  void checkVoxelCount() const {
    constexpr double max_voxels = 2e7;
    double voxels = 0;
    for (const auto& obstacle : obstacles_) voxels += obstacle.around.surface() / (voxel_m_ * voxel_m_);
    if (voxels <= max_voxels) return;
    throw ConfigError("an OctoMap of " + toText(voxel_m_) + " m voxels would have some " +
                      std::to_string(std::llround(voxels / 1e6)) + " million on the faces of solids; make them larger");
  }

  struct Obstacle {
    Solid solid;
    Cuboid around;
  };
  Cuboid cubeAt(const Corner& corner, unsigned depth) const {
    const auto low = [&](std::size_t axis) { return (corner[axis] - kVoxelsToEdge) * voxel_m_; };
    const auto high = [&](std::size_t axis) { return (corner[axis] + sideAt(depth) - kVoxelsToEdge) * voxel_m_; };
    return {{low(0), high(0), low(1), high(1)}, {low(2), high(2)}};
  }

  static std::uint32_t sideAt(unsigned depth) { return 1u << (kDepth - depth); }

  static bool isInside(const Cuboid& cube, const Solid& solid) {
    if (!solid.heights.contains(cube.heights.z_min_m) || !solid.heights.contains(cube.heights.z_max_m)) return false;
    for (const double x : {cube.plan.x_min, cube.plan.x_max}) {
      for (const double y : {cube.plan.y_min, cube.plan.y_max}) {
        if (distance(solid.outline, mrpt::math::TPoint2D(x, y)) > 0) return false;
      }
    }
    return true;
  }

  /// Adds a cube to the tree, recursively.
  /// @param near indices of the obstacles that may overlap it
  void fill(const Corner& corner, unsigned depth, const std::vector<std::uint32_t>& near) {
    const Cuboid cube = cubeAt(corner, depth);
    const Cuboid core = cube.shrunk(kTouch_m);
    const Solid core_solid = core.solid();
    const bool is_voxel = depth == kDepth;
    std::vector<std::uint32_t> inside;
    bool is_occupied = false;
    for (const auto i : near) {
      if (!obstacles_[i].around.overlaps(core) || !overlap(core_solid, obstacles_[i].solid)) continue;
      inside.push_back(i);
      is_occupied = is_occupied || is_voxel || isInside(core, obstacles_[i].solid);
    }
    const bool is_empty = inside.empty();
    const bool is_free = is_empty && (is_voxel ? space_.overlaps(core) : space_.contains(core));
    const bool is_unknown = is_empty && !space_.overlaps(core);
    if (is_occupied) tree_.put(corner, depth, tree_.getClampingThresMaxLog());
    if (is_free) tree_.put(corner, depth, tree_.getClampingThresMinLog());
    if (is_occupied || is_free || is_unknown) {
      count(cube);
      return;
    }
    const std::uint32_t half = sideAt(depth + 1);
    for (std::uint32_t i = 0; i < 8; ++i) {
      fill({corner[0] + (i & 1) * half, corner[1] + (i >> 1 & 1) * half, corner[2] + (i >> 2) * half}, depth + 1,
           inside);
    }
  }

  void count(const Cuboid& cube) {
    done_m3_ += cube.sharedVolume(space_);
    constexpr unsigned kCubesPerReport = 4096;
    if (++cubes_ % kCubesPerReport == 0) progress_(std::min(1.0, done_m3_ / volume_m3_));
  }

  double voxel_m_;
  Tree tree_;
  Cuboid space_;
  std::vector<Obstacle> obstacles_;
  const std::function<void(double)>& progress_;
  double volume_m3_ = 0;
  double done_m3_ = 0;
  unsigned cubes_ = 0;
};

}  // namespace

std::string toOctomap(const World& world, const MapExtent& extent, OctomapForm form,
                      const std::function<void(double)>& progress) {
  return OctomapBuilder(world, extent, progress).write(form);
}

}  // namespace robosim
