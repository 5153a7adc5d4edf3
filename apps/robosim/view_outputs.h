#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rendering/panes.h"
#include "robosim/view_source.h"

namespace robosim {

struct Size {
  int width_px = 0, height_px = 0;
};

/// Which part of a source is shown, and how fast.
struct ViewTimes {
  std::optional<double> from_s;
  std::optional<double> to_s;
  std::optional<double> for_s;  ///< of the clock
  std::optional<double> speed;
  double fps = 20;
};

/// Views of a world that are to ride on a robot that it has not.
enum class AbsentRobots { refused, not_followed };

/// The views of a world; made anew when a run goes on with another one.
using MakePanes = std::function<std::vector<Pane>(const LoadedWorld&, AbsentRobots)>;

/// Opens a window, and returns when the person has closed it.
/// @throws ConfigError when there is no screen.
void showWindow(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times);

bool isVideo(const std::string& file);
/// @throws ConfigError for a name that ends in neither .png nor .mp4, or a file that cannot be written
void checkOffscreenFile(const std::string& file);
/// Writes a picture or a video.
/// @throws std::runtime_error when it is interrupted, or there is no room for the file; nothing is written then. But
/// the video of a run that goes on has what there was to see before Ctrl-C.
void writeOffscreen(ViewSource& source, const MakePanes& make_panes, Size size, const ViewTimes& times,
                    const std::string& file);

/// What draws the panes of a source, whichever world it shows.
class ViewDrawing {
 public:
  ViewDrawing(ViewSource& source, MakePanes make_panes);

  cv::Mat draw(Size size);
  /// Keeps where robots are, for their trails, without a picture.
  void note() { trails_.add(source_.shown()); }
  Panes& panes() { return *panes_; }

 private:
  void make(AbsentRobots absent);

  ViewSource& source_;
  MakePanes make_panes_;
  int world_number_ = 0;
  std::unique_ptr<Panes> panes_;
  Trails trails_;
  std::vector<std::uint8_t> wanted_;
  bool has_asked_ = false;
};

}  // namespace robosim
