#pragma once
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "rendering/ground_view.h"
#include "rendering/shown.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// What a view from above looks at.
struct TopViewCamera {
  int width_px = 960, height_px = 720;
  mrpt::math::TPoint2D center;  ///< world frame [m]
  double px_per_m = 50;
  std::optional<std::size_t> follow;  ///< the robot that stays in the middle, in place of `center`

  /// Shows all of an area.
  static TopViewCamera showing(const Bounds2D& area, int width_px, int height_px);
  /// Zooms by a factor, and keeps what lies under a pixel where it is.
  void zoom(double factor, const mrpt::math::TPoint2D& pixel);
};

/// Which layers a view from above has.
struct TopViewLayers {
  bool trails = true;
  bool sensors = true;  ///< of robots that have readings: sonar fans, laser scans, infrared, heat, bumper
  bool names = true;
};

/// A run from straight above, to scale.
class TopView {
 public:
  /// @param world, fleet must outlive this
  TopView(const World& world, const Fleet& fleet);
  ~TopView();

  /// BGR, 8 bits.
  cv::Mat draw(const Shown& shown, const Trails& trails, const TopViewCamera& camera, const TopViewLayers& layers);
  /// The robot at a pixel, if there is one.
  static std::optional<std::size_t> robotAt(const mrpt::math::TPoint2D& pixel, const Shown& shown, const Fleet& fleet,
                                            const TopViewCamera& camera);
  /// Where the ground lies on the picture.
  static GroundView groundView(const Shown& shown, const TopViewCamera& camera);

 private:
  struct Stills;

  const World& world_;
  const Fleet& fleet_;
  GroundView last_view_;
  std::unique_ptr<const Stills> stills_;  ///< of that view, once it has been drawn twice
};

}  // namespace robosim
