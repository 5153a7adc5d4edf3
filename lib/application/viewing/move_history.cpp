#include "viewing/move_history.h"

#include "base/angle_units.h"
#include "base/text_table.h"

namespace robosim {
namespace {

std::string placeText(const mrpt::math::TPose2D& pose) {
  return "x " + fixed(pose.x, 2) + " m, y " + fixed(pose.y, 2) + " m, " + fixed(toDegrees(pose.phi), 0) + "°";
}

}  // namespace

void MoveHistory::move(const PlaceBody& place, const mrpt::math::TPose2D& was) {
  requested_.push_back({place, was});
  request_(place);
}

void MoveHistory::undo() {
  if (!requested_.empty()) {
    ++undos_due_;
  } else {
    undoNow();
  }
}

void MoveHistory::undoNow() {
  while (!moves_.empty() && !is_present_(moves_.back().place.name)) moves_.pop_back();
  if (moves_.empty()) {
    remark_ = "there is nothing to undo";
    return;
  }
  const auto& [place, was, is_undo, is_outdated] = moves_.back();
  const PlaceBody back{place.name, was.x, was.y, was.phi};
  requested_.push_back({back, was, true});
  request_(back);
}

std::string MoveHistory::answer(const std::string& fault) {
  if (requested_.empty()) return {};
  const Move answered = std::move(requested_.front());
  requested_.pop_front();
  std::string text;
  if (!fault.empty()) {
    text = answered.is_undo ? "not undone: " + fault : fault;
  } else if (answered.is_undo) {
    if (!answered.is_outdated) moves_.pop_back();
    text = "undone: '" + answered.place.name + "' is back at " + placeText(answered.was);
  } else {
    if (!answered.is_outdated) moves_.push_back(answered);
    const PlaceBody& place = answered.place;
    text =
        "'" + place.name + "' is at " + placeText({place.x_m, place.y_m, place.heading_rad.value_or(answered.was.phi)});
  }
  if (requested_.empty() && undos_due_ > 0) {
    --undos_due_;
    undoNow();
  }
  return text;
}

void MoveHistory::clear() {
  moves_.clear();
  for (Move& each : requested_) each.is_outdated = true;
  undos_due_ = 0;
}

}  // namespace robosim
