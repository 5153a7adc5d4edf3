#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "world/body.h"
#include "world/intervention.h"

namespace robosim {

/// The objects of a world, after interventions have changed some of them. Copies share one list, which never changes.
class ChangedObjects {
 public:
  ChangedObjects() = default;
  explicit ChangedObjects(std::vector<WorldObject> objects)
      : objects_(std::make_shared<const std::vector<WorldObject>>(std::move(objects))) {}

  /// Those of the world, until an intervention has changed one.
  const std::vector<WorldObject>& orThose(const std::vector<WorldObject>& of_world) const {
    return objects_ ? *objects_ : of_world;
  }
  bool areChanged() const { return objects_ != nullptr; }
  /// Whether both are the same list; true only if they are equal, in constant time.
  bool isSameList(const ChangedObjects& other) const { return objects_ == other.objects_; }
  bool operator==(const ChangedObjects& other) const {
    return objects_ == other.objects_ || (objects_ && other.objects_ && *objects_ == *other.objects_);
  }

 private:
  std::shared_ptr<const std::vector<WorldObject>> objects_;
};

/// The objects that move during a run, movable ones, doors and walkers, as indices of a list.
std::vector<std::uint32_t> movingObjects(const std::vector<WorldObject>& objects);

/// Indices of the objects at other places in a later list, which differs in nothing else; nullopt if it does.
std::optional<std::vector<std::uint32_t>> movedBetween(const std::vector<WorldObject>& before,
                                                       const std::vector<WorldObject>& after);

/// The objects after a change: one is placed, added, removed or changed. Unchanged by changes of anything else, and by
/// those of an unknown name. Nothing is checked.
std::vector<WorldObject> withChange(std::vector<WorldObject> objects, const Change& change);

}  // namespace robosim
