#include "run/collection.h"

#include <cmath>
#include <limits>

#include "base/text_table.h"

namespace robosim {

void Collection::observe(const Environment& environment) {
  objects_ = collected_ = 0;
  for (const WorldObject& object : environment.objects()) {
    if (!object.movable) continue;
    ++objects_;
    const auto& place = object.body.world_from_body;
    const double x_m = place.x - options_.x_m, y_m = place.y - options_.y_m;
    if (x_m * x_m + y_m * y_m <= options_.radius_m * options_.radius_m) ++collected_;
  }
  if (objects_ == 0) return;
  const double now_s = environment.time().seconds();
  if (!half_s_ && 2 * collected_ >= objects_) half_s_ = now_s;
  if (!all_s_ && collected_ == objects_) all_s_ = now_s;
}

std::string Collection::endReason() const {
  if (options_.end_percent <= 0 || percent() < options_.end_percent) return {};
  return fixed(percent(), 1) + " % collected";
}

std::vector<Metric> Collection::metrics() const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {{"collected", static_cast<double>(collected_)},
          {"collected_percent", percent()},
          {"half_collected_s", half_s_.value_or(kNone)},
          {"all_collected_s", all_s_.value_or(kNone)}};
}

double Collection::percent() const {
  return objects_ == 0 ? 0 : 100 * static_cast<double>(collected_) / static_cast<double>(objects_);
}

ObserverType collectionType() {
  return {"collection",
          "The movable objects that are in a nest, a disc on the floor.",
          {{"x_m", 0, -1e6, 1e6, "m", "x of the nest's centre in the world"},
           {"y_m", 0, -1e6, 1e6, "m", "y of the nest's centre in the world"},
           {"radius_m", CollectionOptions{}.radius_m, 0.01, 1e6, "m", "radius of the nest"},
           {"end_percent", CollectionOptions{}.end_percent, 0, 100, "%", "ends the run at this share; 0: never"}},
          [](const ObserverSetup&, const ParameterValues& p) -> std::unique_ptr<Observer> {
            return std::make_unique<Collection>(CollectionOptions{p["x_m"], p["y_m"], p["radius_m"], p["end_percent"]});
          }};
}

}  // namespace robosim
