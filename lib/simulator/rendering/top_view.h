#pragma once
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "rendering/ground_view.h"
#include "rendering/run_paths.h"
#include "robots/fleet.h"
#include "robots/view_layers.h"
#include "world/world.h"

namespace robosim {

/// Camera of a view from above.
struct TopViewCamera {
  int width_px = 960, height_px = 720;  ///< before scaling
  double scale = 1;                     ///< of the picture, with its lines and text
  mrpt::math::TPoint2D center;          ///< world frame [m]
  double px_per_m = 50;
  std::optional<std::size_t> follow;  ///< the robot kept in the middle; overrides `center`

  /// Shows all of an area.
  static TopViewCamera showing(const Bounds2D& area, int width_px, int height_px);
  /// Zooms by a factor; the world point under `pixel` stays fixed.
  void zoom(double factor, const mrpt::math::TPoint2D& pixel);
};

/// Renders a run from straight above, to scale. With many robots in the picture, DetailLevel omits some layers: sensors
/// except those of the robot that the view follows, names, and of the densest pictures the paths.
class TopView {
 public:
  /// @param world, fleet must outlive this
  TopView(const World& world, const Fleet& fleet);
  ~TopView();

  /// BGR, 8 bits.
  /// @param snapshot absent robots are not drawn
  cv::Mat draw(const RunSnapshot& snapshot, const RunPaths& paths, const TopViewCamera& camera,
               const ViewLayers& layers);
  /// The robot at a pixel, if there is one.
  static std::optional<std::size_t> robotAt(const mrpt::math::TPoint2D& pixel, const RunSnapshot& snapshot,
                                            const Fleet& fleet, const TopViewCamera& camera);
  /// The transform between world and picture.
  static GroundView groundView(const RunSnapshot& snapshot, const TopViewCamera& camera);

 private:
  struct StaticLayers;

  const World& world_;
  const Fleet& fleet_;
  GroundView last_view_;
  double last_scale_ = 1;
  ChangedObjects last_objects_;
  std::unique_ptr<const StaticLayers> static_layers_;  ///< of `last_view_`, created when it is drawn a second time
};

}  // namespace robosim
