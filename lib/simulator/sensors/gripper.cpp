#include "sensors/gripper.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "hardware/gripper_state.h"
#include "sensors/beam_mounts.h"

namespace robosim {
namespace {

/// Where the light barriers are, as shares of the paddles' length.
constexpr double kInnerBeam = 0.25, kOuterBeam = 0.75;

class Gripper : public Sensor {
 public:
  Gripper(const GripperOptions& the_options, SensorInfo info) : options(the_options), info_(std::move(info)) {}
  const SensorInfo& info() const override { return info_; }
  std::size_t rayCount() const override { return 2; }
  bool usesNeighbours() const override { return false; }
  double robotReach(double) const override {
    return portable::hypot(options.front_m + options.reach_m, options.opening_m / 2);
  }
  Measurement blank() const override { return GripperState{}.values(); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      const auto& closed = now.closed_grippers;
      const auto own = std::lower_bound(closed.begin(), closed.end(), robot,
                                        [](const ClosedGripper& one, std::uint32_t of) { return one.robot < of; });
      GripperState state;
      state.is_closed = own != closed.end() && own->robot == robot;
      state.holds = state.is_closed && !own->object.empty();
      state.inner_beam = isInterrupted(now, robot, kInnerBeam);
      state.outer_beam = isInterrupted(now, robot, kOuterBeam);
      std::get<Values>(readings[robot].measurements[slot]) = state.values();
    }
  }

  const GripperOptions options;

 private:
  bool isInterrupted(const Snapshot& now, std::uint32_t robot, double share) const {
    const auto& frame = now.frames[robot];
    const double x_m = options.front_m + share * options.reach_m;
    auto from = frame.pointToWorld({x_m, options.opening_m / 2, 0});
    auto to = frame.pointToWorld({x_m, -options.opening_m / 2, 0});
    from.z = to.z = options.z_m;
    const mrpt::math::TPoint3D direction = (to - from) * (1 / options.opening_m);
    return static_cast<bool>(now.scene.castRay({from, direction}, options.opening_m, now.bodyOf(robot)));
  }

  SensorInfo info_;
};

}  // namespace

bool GripperOptions::isBetweenPaddles(const mrpt::math::TPoint2D& center, double radius_m) const {
  return center.x > 0 && center.x <= front_m + reach_m && std::abs(center.y) + radius_m <= opening_m / 2;
}

std::unique_ptr<Sensor> readGripper(XmlReader& reader, const Mount& mount) {
  GripperOptions o;
  SensorInfo info;
  info.kind = SensorKind::values;
  info.label = reader.word("label", "gripper");
  info.quantities = GripperState::quantities();
  o.front_m = mount.robot_radius_m;
  o.reach_m = reader.number("reach_m", Bounds::positive(10), o.reach_m);
  o.opening_m = reader.number("opening_m", Bounds::positive(10), o.opening_m);
  o.z_m = reader.number("z_m", Bounds::notNegative(10), o.z_m);
  info.beams.push_back(planarBeam(o.front_m, 0, o.z_m, 0));
  const bool has_one = std::any_of(mount.mounted.begin(), mount.mounted.end(),
                                   [](const auto& sensor) { return gripperOptionsOf(*sensor) != nullptr; });
  if (has_one) reader.error("is the second gripper of its robot; mount one");
  return std::make_unique<Gripper>(o, std::move(info));
}

const GripperOptions* gripperOptionsOf(const Sensor& sensor) {
  const auto* gripper = dynamic_cast<const Gripper*>(&sensor);
  return gripper ? &gripper->options : nullptr;
}

}  // namespace robosim
