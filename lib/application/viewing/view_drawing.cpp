#include <utility>

#include "rendering/offscreen_renderer.h"
#include "viewing/view_outputs.h"

namespace robosim {

ViewDrawing::ViewDrawing(ViewSource& source, MakePanes make_panes, const ViewLayers& layers, RobotSelection only)
    : source_(source), make_panes_(std::move(make_panes)), only_(std::move(only)), world_number_(source.worldNumber()) {
  make(AbsentRobots::refused, layers);
}

void ViewDrawing::make(AbsentRobots absent, ViewLayers layers) {
  const LoadedWorld& world = source_.world();
  auto panes = make_panes_(world, absent);
  auto renderer = std::make_shared<std::unique_ptr<OffscreenRenderer>>();
  if (std::any_of(panes.begin(), panes.end(), [](const Pane& pane) { return pane.is_3d; })) {
    *renderer = std::make_unique<OffscreenRenderer>(world.world, world.fleet);
  }
  const Panes::Draw3d draw_3d = [renderer, &world](const CameraInfo& camera,
                                                   const mrpt::math::TPose3D& world_from_camera, const SeenWorld& seen,
                                                   DepthBuffer* depth) {
    if (!*renderer) *renderer = std::make_unique<OffscreenRenderer>(world.world, world.fleet);
    return (*renderer)->picture(camera, world_from_camera, seen, depth);
  };
  layers.only = only_.flagsIn(world.fleet, absent == AbsentRobots::refused ? RobotSelection::Unmatched::refused
                                                                           : RobotSelection::Unmatched::ignored);
  const auto look = panes_ ? panes_->look() : Panes::Look{};
  panes_ = std::make_unique<Panes>(world.world, world.fleet, std::move(panes), draw_3d);
  panes_->layers() = layers;
  panes_->look() = look;
  has_requested_ = false;
}

cv::Mat ViewDrawing::draw(Size size) {
  if (std::exchange(world_number_, source_.worldNumber()) != source_.worldNumber()) {
    make(AbsentRobots::not_followed, panes_->layers());
  }
  panes_->resize(size.width_px, size.height_px);
  if (auto requested = panes_->requestedReadings(); !has_requested_ || requested != requested_) {
    source_.requestReadings(requested);
    requested_ = std::move(requested);
    has_requested_ = true;
  }
  return panes_->draw(source_.snapshot(), source_.paths());
}

}  // namespace robosim
