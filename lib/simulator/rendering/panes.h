#pragma once
#include <functional>
#include <optional>
#include <vector>

#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "hardware/sensor_info.h"
#include "rendering/depth_buffer.h"
#include "rendering/pane_projection.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"

namespace robosim {

/// Camera that orbits a point of the ground, or is mounted behind a robot.
struct OrbitCamera {
  mrpt::math::TPoint2D target;     ///< world frame [m]
  double distance_m = 10;          ///< from the target
  double azimuth_rad = -M_PI / 2;  ///< of the camera as seen from the target; with a robot, relative to its tail
  double elevation_rad = 0.7;      ///< (0, π/2)
  double field_of_view_rad = 0.9;

  /// The camera's x is along the optical axis, z up.
  /// @param robot that the camera is mounted on, or null
  mrpt::math::TPose3D worldFromCamera(const mrpt::math::TPose2D* robot) const;
};

/// One view within a picture.
struct Pane {
  bool is_3d = false;
  std::optional<std::size_t> follow;  ///< the robot that the view follows
  TopViewCamera top;                  ///< of a 2D pane
  OrbitCamera air;                    ///< of a 3D pane
};

/// The initial pane: the whole world, fitted when the pane's size is known, or the surroundings of a robot.
Pane makePane(bool is_3d, std::optional<std::size_t> follow, const World& world);

/// Several views of one run, side by side on a picture.
class Panes {
 public:
  /// Renders a 3D pane or an inset: BGR, of the camera's size; if `depth` is not null, with the depths of the picture
  /// (OffscreenRenderer::picture()). Called only for these.
  using Draw3d = std::function<cv::Mat(const CameraInfo&, const mrpt::math::TPose3D& world_from_camera,
                                       const SeenWorld& seen, DepthBuffer* depth)>;

  /// Style of the whole picture.
  struct Look {
    double scale = 1;           ///< of lines and text, > 0
    bool antialias = false;     ///< 3D: renders at twice the resolution
    bool camera_inset = false;  ///< picture of the followed robot's camera, or of the first present robot with one
  };

  Panes(const World& world, const Fleet& fleet, std::vector<Pane> panes, Draw3d draw_3d);

  void resize(int width_px, int height_px);
  /// The whole picture, BGR.
  cv::Mat draw(const RunSnapshot& whole, const RunPaths& paths);

  ViewLayers& layers() { return layers_; }
  Look& look() { return look_; }
  /// Flags of the robots whose readings the panes show, by robot; empty for all robots.
  std::vector<std::uint8_t> requestedReadings() const;

  /// @name Mouse input; in pixels of the whole picture
  ///@{
  enum class Drag { pan, turn };
  void drag(const mrpt::math::TPoint2D& at, const mrpt::math::TPoint2D& by_px, Drag how);
  void zoom(const mrpt::math::TPoint2D& at, double factor);
  /// Follows the robot at a pixel; stops following if there is none.
  void click(const mrpt::math::TPoint2D& at, const RunSnapshot& snapshot);
  ///@}
  /// The pane at a pixel; nullopt between panes.
  std::optional<std::size_t> paneAt(const mrpt::math::TPoint2D& at) const;
  /// How a pane shows the world at present.
  PaneProjection projection(std::size_t pane, const RunSnapshot& snapshot) const;
  /// All panes: shows the whole world, and follows no robot.
  void showAll();
  /// All panes: follows the next robot that is present.
  void followNext(const RunSnapshot& snapshot);

 private:
  cv::Rect rectOf(std::size_t pane) const;
  Pane* findPane(const mrpt::math::TPoint2D& at, mrpt::math::TPoint2D& pixel_in_pane);
  CameraInfo airCamera(std::size_t pane) const;
  mrpt::math::TPose3D worldFromAirCamera(const Pane& pane, const RunSnapshot& snapshot) const;
  cv::Mat drawPane(std::size_t index, const RunSnapshot& snapshot, const RunPaths& paths);
  void fit(Pane& pane, std::size_t index) const;
  void setTopSize(Pane& pane, std::size_t index) const;
  cv::Mat render(CameraInfo camera, const mrpt::math::TPose3D& world_from_camera, const RunSnapshot& snapshot,
                 DepthBuffer* depth);
  void drawInset(cv::Mat& picture, const RunSnapshot& snapshot);

  const World& world_;
  const Fleet& fleet_;
  std::vector<Pane> panes_;
  Draw3d draw_3d_;
  TopView top_view_;
  ViewLayers layers_;
  Look look_;
  double fitted_scale_ = 1;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace robosim
