#include "viewing/recorded_objects.h"

#include <optional>
#include <utility>

namespace robosim {
namespace {

/// Places that are kept after a complete list, as a multiple of its length: bounds the time of RecordedObjects::at().
constexpr std::size_t kPlacesPerObject = 32;

}  // namespace

void RecordedObjects::add(const ChangedObjects& objects) {
  const std::vector<WorldObject>& now = objects.orThose(of_world_);
  const bool is_first = lists_.empty();
  if (is_first || !objects.isSameList(last_)) {
    const auto moved = is_first ? std::nullopt : movedBetween(last_.orThose(of_world_), now);
    if (moved && places_.size() - lists_.back().places_from + moved->size() <= kPlacesPerObject * now.size()) {
      for (const std::uint32_t i : *moved) {
        places_.push_back({i, now[i].body.world_from_body, now[i].door ? now[i].door->share : 0});
      }
    } else {
      lists_.push_back({objects, places_.size()});
    }
    last_ = objects;
  }
  moments_.push_back({static_cast<std::uint32_t>(lists_.size() - 1), places_.size()});
}

ChangedObjects RecordedObjects::at(std::size_t moment) {
  const Moment& wanted = moments_.at(moment);
  const List& list = lists_[wanted.list];
  if (wanted.places_to == list.places_from) return list.objects;
  if (wanted == shown_) return shown_objects_;
  std::vector<WorldObject> objects = list.objects.orThose(of_world_);
  for (std::size_t k = list.places_from; k < wanted.places_to; ++k) {
    const Place& place = places_[k];
    WorldObject& object = objects[place.object];
    object.body.world_from_body = place.world_from_object;
    if (object.door) object.door->share = place.door_share;
  }
  shown_ = wanted;
  return shown_objects_ = ChangedObjects(std::move(objects));
}

}  // namespace robosim
