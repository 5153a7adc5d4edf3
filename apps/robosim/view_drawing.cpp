#include <utility>

#include "rendering/offscreen_renderer.h"
#include "robosim/view_outputs.h"

namespace robosim {

ViewDrawing::ViewDrawing(ViewSource& source, MakePanes make_panes)
    : source_(source), make_panes_(std::move(make_panes)), world_number_(source.worldNumber()) {
  make(AbsentRobots::refused);
}

void ViewDrawing::make(AbsentRobots absent) {
  const LoadedWorld& world = source_.world();
  auto panes = make_panes_(world, absent);
  Panes::Draw3d draw_3d;
  if (std::any_of(panes.begin(), panes.end(), [](const Pane& pane) { return pane.is_3d; })) {
    auto renderer = std::make_shared<OffscreenRenderer>(world.world, world.fleet);
    draw_3d = [renderer](const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera,
                         std::span<const mrpt::math::TPose2D> world_from_robot) {
      return renderer->picture(camera, world_from_camera, world_from_robot);
    };
  }
  panes_ = std::make_unique<Panes>(world.world, world.fleet, std::move(panes), std::move(draw_3d));
  trails_.clear();
  has_asked_ = false;
}

cv::Mat ViewDrawing::draw(Size size) {
  if (std::exchange(world_number_, source_.worldNumber()) != source_.worldNumber()) {
    make(AbsentRobots::not_followed);
  }
  panes_->resize(size.width_px, size.height_px);
  trails_.add(source_.shown());
  if (auto wanted = panes_->wantedReadings(); !has_asked_ || wanted != wanted_) {
    source_.want(wanted);
    wanted_ = std::move(wanted);
    has_asked_ = true;
  }
  return panes_->draw(source_.shown(), trails_);
}

}  // namespace robosim
