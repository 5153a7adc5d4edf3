#include "viewing/body_dragging.h"

#include <cmath>
#include <utility>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;
using mrpt::math::TPose2D;

/// Motions of the mouse up to this are part of a click.
constexpr double kClick_px = 3;
/// Nearer to a body's centre, the mouse gives no direction.
constexpr double kLever_px = 6;

/// The outline of a body in plan, about its centre.
std::vector<TPoint2D> rimOf(const Body& body) {
  if (const auto* cube = std::get_if<Cube>(&body.shape)) {
    const double x = cube->length_m / 2, y = cube->width_m / 2;
    return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  }
  constexpr int kCorners = 32;
  std::vector<TPoint2D> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2 * M_PI * i / kCorners;
    rim.push_back(TPoint2D(std::cos(angle_rad), std::sin(angle_rad)) * std::get<Cylinder>(body.shape).radius_m);
  }
  return rim;
}

}  // namespace

BodyDragging::BodyDragging(ViewSource& source, ViewDrawing& drawing)
    : source_(source),
      drawing_(drawing),
      history_(
          [this](const Change& change) { source_.change(change); },
          [this](const std::string& name) { return bodyNamed(name, source_.snapshot(), source_.world()).has_value(); }),
      world_number_(source.worldNumber()) {}

bool BodyDragging::press(const TPoint2D& pixel, How how) {
  const auto pane = drawing_.panes().paneAt(pixel);
  if (!pane) return false;
  const PaneProjection projection = drawing_.panes().projection(*pane, source_.snapshot());
  const auto body = pickBody(projection, pixel, source_.snapshot(), source_.world());
  if (!body) return false;
  if (std::string why = source_.whyUnchangeable(); !why.empty()) {
    notice_ = std::move(why);
    return true;
  }
  const TPose2D& pose = body->body.world_from_body;
  const auto grip = projection.onLevel(body->at_z_m, pixel);
  dragged_ = {*pane, how, *body, pixel, TPoint2D(pose.x, pose.y) - grip.value_or(TPoint2D(pose.x, pose.y)),
              false, pose};
  return true;
}

void BodyDragging::drag(const TPoint2D& pixel) {
  if (!dragged_) return;
  if (!dragged_->has_moved && (pixel - dragged_->pressed_at).norm() <= kClick_px) return;
  const auto at = projection().onLevel(dragged_->body.at_z_m, pixel);
  if (!at) return;
  TPose2D& to = dragged_->to;
  if (dragged_->how == How::move) {
    dragged_->has_moved = true;
    to = {at->x + dragged_->body_from_grip.x, at->y + dragged_->body_from_grip.y, to.phi};
    return;
  }
  const auto center = projection().pixelOf({to.x, to.y, dragged_->body.at_z_m});
  if (!center || (pixel - *center).norm() < kLever_px) return;
  dragged_->has_moved = true;
  to.phi = std::atan2(at->y - to.y, at->x - to.x);
}

void BodyDragging::release() {
  if (!dragged_) return;
  const Dragged done = *std::exchange(dragged_, std::nullopt);
  if (!done.has_moved) return;
  const std::string& name = done.body.name;
  const auto now = bodyNamed(name, source_.snapshot(), source_.world());
  if (!now) {
    notice_ = "'" + name + "' is no longer in the world";
    return;
  }
  const TPose2D& was = now->body.world_from_body;
  if (done.how == How::move) {
    history_.move({name, done.to.x, done.to.y}, was);
  } else {
    history_.move({name, was.x, was.y, done.to.phi}, was);
  }
  update();
}

void BodyDragging::undo() {
  cancel();
  if (std::string why = source_.whyUnchangeable(); !why.empty()) {
    notice_ = std::move(why);
    return;
  }
  history_.undo();
  update();
}

void BodyDragging::update() {
  if (std::exchange(world_number_, source_.worldNumber()) != source_.worldNumber()) {
    cancel();
    history_.clear();
  }
  // An answer may have an undo requested, which a run of this process answers at once.
  for (auto answers = source_.takeAnswers(); !answers.empty(); answers = source_.takeAnswers()) {
    for (const auto& answer : answers) notice_ = history_.answer(answer);
  }
  if (std::string remark = history_.takeRemark(); !remark.empty()) notice_ = std::move(remark);
  if (!dragged_) return;
  const auto now = bodyNamed(dragged_->body.name, source_.snapshot(), source_.world());
  if (!now) {
    cancel();
    return;
  }
  dragged_->body.body = now->body;
  TPose2D& to = dragged_->to;
  const TPose2D& pose = now->body.world_from_body;
  to = dragged_->how == How::turn || !dragged_->has_moved ? TPose2D(pose.x, pose.y, to.phi)
                                                          : TPose2D(to.x, to.y, pose.phi);
}

std::optional<BodyDragging::Outline> BodyDragging::outline() const {
  if (!dragged_ || !dragged_->has_moved) return std::nullopt;
  const Body& body = dragged_->body.body;
  const PaneProjection pane = projection();
  Outline outline;
  outline.color = body.color;
  const auto add = [&](std::vector<TPoint2D>& line, const TPoint2D& at, double z_m) {
    if (const auto pixel = pane.pixelOf({at.x, at.y, z_m})) line.push_back(*pixel);
  };
  const double top_m = body.heights().z_max_m;
  std::vector<double> levels{top_m};
  if (!pane.isFromAbove()) levels.insert(levels.begin(), body.heights().z_min_m);
  for (const double z_m : levels) {
    auto& rim = outline.rims.emplace_back();
    for (const auto& corner : rimOf(body)) add(rim, dragged_->to.composePoint(corner), z_m);
  }
  const double ahead_m = body.coveringRadius();
  for (const double x : {0.0, ahead_m}) add(outline.heading, dragged_->to.composePoint(TPoint2D(x, 0)), top_m);
  if (dragged_->how == How::move) {
    for (const TPose2D& pose : {body.world_from_body, dragged_->to}) add(outline.way, {pose.x, pose.y}, top_m);
  }
  return outline;
}

std::string BodyDragging::takeNotice() { return std::exchange(notice_, {}); }

}  // namespace robosim
