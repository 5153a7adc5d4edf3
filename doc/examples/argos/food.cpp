// Items of food are black discs on the floor. A robot on one takes it: the item is away until the robot is in the nest,
// and then lies at another random place.
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <robosim/base/random.h>
#include <robosim/environment/environment.h>

#include "types.h"

namespace {

constexpr double kNest_m = -1;            // the nest is where x is below this
constexpr double kArea_m = 1.8;           // items lie at x in [-0.8, 1.8], y in [-1.8, 1.8]
constexpr double kAway_m[] = {2.4, 2.4};  // behind the walls

class Food : public robosim::Observer {
 public:
  explicit Food(std::uint64_t seed) : random_(seed, robosim::RandomPurpose::scenery) {}

  void observe(const robosim::Environment& environment) override {
    carried_.resize(environment.state().world_from_robot.size());
  }

  void supervise(robosim::Supervisor& supervisor) override {
    const auto& environment = supervisor.environment();
    const auto& poses = environment.state().world_from_robot;
    for (std::size_t robot = 0; robot < poses.size(); ++robot) {
      if (carried_[robot] && poses[robot].x < kNest_m) {
        const double x_m = -0.8 + (kArea_m + 0.8) * random_.uniform(), y_m = kArea_m * (2 * random_.uniform() - 1);
        static_cast<void>(supervisor.apply(robosim::PlaceBody{*carried_[robot], x_m, y_m}));
        carried_[robot].reset();
        ++collected_;
      } else if (!carried_[robot] && poses[robot].x >= kNest_m) {
        carried_[robot] = itemUnder(environment, poses[robot]);
        if (carried_[robot])
          static_cast<void>(supervisor.apply(robosim::PlaceBody{*carried_[robot], kAway_m[0], kAway_m[1]}));
      }
    }
  }

  std::vector<robosim::Metric> metrics() const override { return {{"collected", static_cast<double>(collected_)}}; }

 private:
  /// The name of the item under one of the robot's front sensors, 63 mm before its centre.
  static std::optional<std::string> itemUnder(const robosim::Environment& environment,
                                              const mrpt::math::TPose2D& pose) {
    for (const auto& object : environment.objects()) {
      if (!object.name.starts_with("Food")) continue;
      for (const double left_m : {0.0116, -0.0116}) {
        const auto sensor = pose.composePoint(mrpt::math::TPoint2D(0.063, left_m));
        const double radius_m = std::get<robosim::Cylinder>(object.body.shape).radius_m;
        const auto& center = object.body.world_from_body;
        if (std::hypot(sensor.x - center.x, sensor.y - center.y) <= radius_m) return object.name;
      }
    }
    return std::nullopt;
  }

  robosim::Rng random_;
  std::vector<std::optional<std::string>> carried_;  ///< by robot: the item's name
  int collected_ = 0;
};

}  // namespace

robosim::ObserverType argosFoodType() {
  robosim::ObserverType type{
      "argos_food",
      "Food that robots take on black discs, and drop in the nest.",
      {},
      [](const robosim::ObserverSetup& setup, const robosim::ParameterValues&) -> std::unique_ptr<robosim::Observer> {
        return std::make_unique<Food>(setup.seed);
      }};
  type.supervises = true;
  return type;
}
