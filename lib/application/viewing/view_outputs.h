#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rendering/figure_page.h"
#include "rendering/panes.h"
#include "robots/robot_selection.h"
#include "viewing/view_source.h"

namespace robosim {

struct Size {
  int width_px = 0, height_px = 0;
};

/// Time range and speed of a view.
struct ViewTimes {
  std::optional<double> from_s;
  std::optional<double> to_s;
  std::optional<double> for_s;  ///< wall time
  std::optional<double> speed;
  double fps = 20;
};

/// Handling of views that follow a robot which the world does not have.
enum class AbsentRobots { refused, not_followed };

/// Creates the panes of a world; called again when a run continues with another world.
using MakePanes = std::function<std::vector<Pane>(const LoadedWorld&, AbsentRobots)>;

/// Opens a window, and returns when it is closed. When the connection to the environment is lost, the window stays open
/// and shows the reason.
/// @param layers that are shown at first @param only the robots that are shown
/// @throws ConfigError when there is no display, or for a selection without a robot
void showWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                const Panes::Look& look = {}, const ViewLayers& layers = {}, const RobotSelection& only = {});

/// Whether a file name is that of a figure: .svg or .pdf.
bool isFigure(const std::string& file);
/// @throws ConfigError for a name that ends in none of .png, .svg, .pdf, .mp4, .webm and .webp, or a file that cannot
/// be written
void checkOffscreenFile(const std::string& file);
/// Writes a picture or a video.
/// @throws Interrupted, and std::runtime_error when the disk is full; no file is written then. Exception: an
/// interrupted video of a live run is kept up to the interruption.
/// @throws ConfigError for a selection without a robot
void writeOffscreen(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                    const std::string& file, const Panes::Look& look = {}, const ViewLayers& layers = {},
                    const RobotSelection& only = {});

/// Writes a figure: the whole world from above, with paths, ranges of sensors, robots and names, as vectors.
/// @throws ConfigError when the text is too large for the page, or for a selection without a robot
void writeViewFigure(ViewSource& source, const ViewTimes& times, const std::string& file, const FigurePage& page,
                     ViewLayers layers = {}, const RobotSelection& only = {});
/// Goes to the moment of a picture: for a recording its end or `times.to_s`, else the newest step.
void showPictureTime(ViewSource& source, const ViewTimes& times);

/// Draws the panes of a source, and recreates them when its world changes.
class ViewDrawing {
 public:
  /// @param layers that are shown at first @param only the robots that are shown, in each world
  /// @throws ConfigError for a selection without a robot in the first world
  ViewDrawing(ViewSource& source, MakePanes make_panes, const ViewLayers& layers = {}, RobotSelection only = {});

  cv::Mat draw(Size size);
  Panes& panes() { return *panes_; }

 private:
  void make(AbsentRobots absent, ViewLayers layers);

  ViewSource& source_;
  MakePanes make_panes_;
  RobotSelection only_;
  int world_number_ = 0;
  std::unique_ptr<Panes> panes_;
  std::vector<std::uint8_t> requested_;
  bool has_requested_ = false;
};

}  // namespace robosim
