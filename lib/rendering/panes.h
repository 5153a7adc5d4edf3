#pragma once
#include <functional>
#include <optional>
#include <vector>

#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "hardware/sensor_info.h"
#include "rendering/shown.h"
#include "rendering/top_view.h"

namespace robosim {

/// Where an eye in the air is: round a point of the ground, or riding on a robot.
struct AirCamera {
  mrpt::math::TPoint2D target;     ///< world frame [m]
  double distance_m = 10;          ///< from the target
  double azimuth_rad = -M_PI / 2;  ///< where the eye is, as seen from the target; on a robot: from its tail
  double elevation_rad = 0.7;      ///< (0, π/2)
  double field_of_view_rad = 0.9;

  /// The camera's x is along the optical axis, z up.
  /// @param robot that it rides on, or null
  mrpt::math::TPose3D worldFromCamera(const mrpt::math::TPose2D* robot) const;
};

/// One of the views on a picture.
struct Pane {
  bool is_3d = false;
  std::optional<std::size_t> follow;  ///< the robot that it rides on
  TopViewCamera top;                  ///< of a 2D pane
  AirCamera air;                      ///< of a 3D pane
};

/// What a pane is at first: all of the world, once it is known how large it is drawn, or the surroundings of a robot.
Pane makePane(bool is_3d, std::optional<std::size_t> follow, const World& world);

/// Several views of one run, side by side on a picture.
class Panes {
 public:
  /// Draws in three dimensions: BGR, of the camera's size. Asked for only when there is a 3D pane.
  using Draw3d = std::function<cv::Mat(const CameraInfo&, const mrpt::math::TPose3D& world_from_camera,
                                       std::span<const mrpt::math::TPose2D> world_from_robot)>;

  Panes(const World& world, const Fleet& fleet, std::vector<Pane> panes, Draw3d draw_3d);

  void resize(int width_px, int height_px);
  /// The whole picture, BGR.
  cv::Mat draw(const Shown& shown, const Trails& trails);

  TopViewLayers& layers() { return layers_; }
  /// Whose readings there should be: by robot, 1 for those; empty for all.
  std::vector<std::uint8_t> wantedReadings() const;

  /// @name What a hand does; in pixels of the whole picture
  ///@{
  enum class Drag { pan, turn };
  void drag(const mrpt::math::TPoint2D& at, const mrpt::math::TPoint2D& by_px, Drag how);
  void zoom(const mrpt::math::TPoint2D& at, double factor);
  /// Follows the robot there, or stops following.
  void click(const mrpt::math::TPoint2D& at, const Shown& shown);
  ///@}
  /// All panes: show everything, and follow nobody.
  void showAll();
  /// All panes: ride on the next robot.
  void followNext();

 private:
  cv::Rect rectOf(std::size_t pane) const;
  Pane* paneAt(const mrpt::math::TPoint2D& at, mrpt::math::TPoint2D& in_pane);
  cv::Mat drawPane(const Pane& pane, const Shown& shown, const Trails& trails);
  void fit(Pane& pane, std::size_t index) const;

  const World& world_;
  const Fleet& fleet_;
  std::vector<Pane> panes_;
  Draw3d draw_3d_;
  TopView top_view_;
  TopViewLayers layers_;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace robosim
