#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "rendering/body_picking.h"
#include "viewing/move_history.h"
#include "viewing/view_outputs.h"

namespace robosim {

/// Moves and turns robots and objects of a run with the mouse. While one is dragged, only its outline moves; the run
/// changes when the button is released (PlaceBody). Pixels are those of the whole picture.
class BodyDragging {
 public:
  enum class How {
    move,  ///< the body follows the mouse and keeps its heading
    turn,  ///< its front turns towards the mouse
  };
  /// The outline of the dragged body, for drawing; in pixels.
  struct Outline {
    std::vector<std::vector<mrpt::math::TPoint2D>> rims;  ///< closed; the last is its top
    std::vector<mrpt::math::TPoint2D> heading;            ///< from its centre ahead; empty if it is not visible
    std::vector<mrpt::math::TPoint2D> way;                ///< from where it is to where it would be
    std::array<float, 3> color{};
  };

  /// @param source, drawing must outlive this
  BodyDragging(ViewSource& source, ViewDrawing& drawing);

  /// Begins to drag what is under the mouse. @return false if nothing is
  bool press(const mrpt::math::TPoint2D& pixel, How how);
  void drag(const mrpt::math::TPoint2D& pixel);
  void release();
  void cancel() { dragged_.reset(); }
  bool isDragging() const { return dragged_.has_value(); }
  void undo();

  /// Takes the run's answers; to be called before each repaint.
  void update();
  std::optional<Outline> outline() const;
  /// What has been done, or why not; empty when there is nothing new to say.
  std::string takeNotice();

 private:
  struct Dragged {
    std::size_t pane;
    How how;
    PickedBody body;
    mrpt::math::TPoint2D pressed_at;
    mrpt::math::TPoint2D body_from_grip;  ///< its centre relative to the point at which it is held, world frame [m]
    bool has_moved = false;
    mrpt::math::TPose2D to;
  };

  PaneProjection projection() const { return drawing_.panes().projection(dragged_->pane, source_.snapshot()); }

  ViewSource& source_;
  ViewDrawing& drawing_;
  MoveHistory history_;
  int world_number_;
  std::optional<Dragged> dragged_;
  std::string notice_;
};

}  // namespace robosim
