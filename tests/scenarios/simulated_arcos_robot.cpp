#include "tests/scenarios/simulated_arcos_robot.h"

#include <cmath>
#include <utility>

#include "base/angle_units.h"
#include "environment/testing/small_world.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"

namespace robosim {
namespace {

FleetRobot shippedRobot(const std::string& type) {
  return robotOfType(robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), type);
}

}  // namespace

std::unique_ptr<Environment> robotAlone(const std::string& type, const mrpt::math::TPose2D& start, double room_m) {
  World world = emptyWorld(20);
  if (room_m > 0) {
    constexpr double kThick_m = 0.2;
    const double at_m = (room_m + kThick_m) / 2;
    for (const double side : {-1.0, 1.0}) {
      addWall(world, side * at_m, 0, kThick_m, room_m);
      addWall(world, 0, side * at_m, room_m, kThick_m);
    }
  }
  Fleet fleet;
  fleet.robots.push_back(shippedRobot(type));
  fleet.robots.front().world_from_start = start;
  return std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
}

ArcosRobotType readArcosType(const std::string& type) {
  const FleetRobot robot = shippedRobot(type);
  return {robot.info, *robot.model->arcos};
}

class SimulatedArcosRobot::Channel final : public ByteChannel {
 public:
  Channel(SimulatedArcosRobot& robot, Noise to_robot, Noise from_robot)
      : robot_(robot), to_robot_(std::move(to_robot)), from_robot_(std::move(from_robot)) {}

  std::string read(Clock::duration) override {
    if (robot_.pending_.empty()) robot_.step();
    std::string bytes = std::exchange(robot_.pending_, {});
    if (robot_.is_silent) return {};
    return from_robot_ ? from_robot_(std::move(bytes)) : bytes;
  }
  void write(std::string_view bytes) override {
    const std::string arriving = to_robot_ ? to_robot_(std::string(bytes)) : std::string(bytes);
    robot_.pending_ += robot_.session_.receive(arriving, robot_.now_);
  }
  Clock::time_point now() const override { return robot_.now_; }
  const std::string& name() const override { return name_; }

 private:
  SimulatedArcosRobot& robot_;
  Noise to_robot_, from_robot_;
  std::string name_ = "memory";
};

SimulatedArcosRobot::SimulatedArcosRobot(const std::string& type, const mrpt::math::TPose2D& start, double room_m)
    : type_(type),
      environment_(robotAlone(type, start, room_m)),
      hardware_(*environment_, 0),
      robot_(hardware_),
      board_(robot_, *environment_->fleet().robots[0].model->arcos),
      session_(board_, *this, now_) {}

void SimulatedArcosRobot::step() {
  pending_ += session_.receive({}, now_);
  session_.beforeStep(now_);
  environment_->step();
  now_ += std::chrono::milliseconds(100);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const arcos::LaserRequest& laser = session_.lasers()[i];
    scans_[i].ranges_mm.clear();
    if (laser.form == arcos::LaserRequest::Form::off) continue;
    if (!ArcosLasers::has(*environment_->fleet().robots[0].model, i)) continue;
    const ArcosLasers::Request request{0, i, laser, &scans_[i]};
    ArcosLasers(*environment_).measure(std::span(&request, 1));
  }
  pending_ += session_.cycle();
}

void SimulatedArcosRobot::setTruePose(const arcos::SimPose& pose) {
  const PlaceBody place{environment_->robotNames()[0], pose.x_mm / 1000.0, pose.y_mm / 1000.0,
                        toRadians(pose.heading_deg)};
  const std::string fault = environment_->apply({"ARCOS program", place});
  if (!fault.empty()) log(fault);
}

std::unique_ptr<ByteChannel> SimulatedArcosRobot::channel(Noise to_robot, Noise from_robot) {
  return std::make_unique<Channel>(*this, std::move(to_robot), std::move(from_robot));
}

ArcosHardware::Options SimulatedArcosRobot::options() {
  ArcosHardware::Options options;
  options.type_of = [this](const std::string&) { return readArcosType(type_); };
  options.log = [this](const std::string& line) { log_text += line + '\n'; };
  return options;
}

}  // namespace robosim
