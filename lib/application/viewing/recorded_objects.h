#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "world/changed_objects.h"

namespace robosim {

/// The objects of a recording at each of its moments. Of moments at which objects have only moved, the places of those
/// are kept (40 bytes each), between complete lists.
class RecordedObjects {
 public:
  /// @param of_world the objects of the recorded world; must outlive this
  explicit RecordedObjects(const std::vector<WorldObject>& of_world) : of_world_(of_world) {}

  /// Adds those of the next moment.
  void add(const ChangedObjects& objects);
  /// Those of a moment, counted from 0 in the order in which they were added.
  ChangedObjects at(std::size_t moment);
  /// Numbers of complete lists and of places that are kept.
  std::size_t listCount() const { return lists_.size(); }
  std::size_t placeCount() const { return places_.size(); }

 private:
  struct Place {
    std::uint32_t object;
    mrpt::math::TPose2D world_from_object;
    double door_share;  ///< 0 for what is no door
  };
  struct List {
    ChangedObjects objects;
    std::size_t places_from;
  };
  /// A list, with the places up to `places_to` in their order.
  struct Moment {
    std::uint32_t list = 0;
    std::size_t places_to = 0;
    bool operator==(const Moment&) const = default;
  };

  const std::vector<WorldObject>& of_world_;
  ChangedObjects last_;  ///< that were added
  std::vector<List> lists_;
  std::vector<Place> places_;
  std::vector<Moment> moments_;
  Moment shown_;  ///< the last result of at()
  ChangedObjects shown_objects_;
};

}  // namespace robosim
