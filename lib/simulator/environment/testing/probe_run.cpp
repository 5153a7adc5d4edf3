#include "environment/testing/probe_run.h"

#include "base/random.h"
#include "environment/testing/small_world.h"
#include "sensors/blob_finder.h"

namespace robosim {
namespace {

constexpr const char* kProbe = R"(<robot name="probe" help="Has every kind of sensor.">
  <body radius_m="0.2" height_m="0.3" fiducial="9"/>
  <limits speed_max_mps="1" accel_mps2="1" decel_mps2="2" emergency_decel_mps2="3" turn_max_degps="100" turn_accel_degps2="200"/>
  <sensors>
    <sonar range_max_m="3" beam_width_deg="20" noise="polaroid">
      <noise dropout="0.05" ringing="0.05" crosstalk="0.1" robot_crosstalk="0.2"/>
      <at x_m="0.2" z_m="0.1" angle_deg="0"/>
      <at y_m="0.2" z_m="0.1" angle_deg="90"/>
    </sonar>
    <sonar range_max_m="3" model="rays" rays="5" firing_interval_s="0.04" array="4">
      <noise wall_deg="30" far_deg="10" second_echoes="1"/>
      <ring count="8" radius_m="0.2" z_m="0.1"/>
    </sonar>
    <infrared noise="gp2d12"><noise dropout="0.1"/> <ring count="4" radius_m="0.2" z_m="0.1"/></infrared>
    <laser beams="5" field_of_view_deg="180" range_max_m="4" z_m="0.1"><noise/></laser>
    <laser label="sweeping" noise="lms200" beams="21" range_max_m="4" z_m="0.1" rate_hz="7" latency_s="0.02"
           latency_std_s="0.05" latency_tail="0.3"/>
    <heat range_max_m="3"><noise lag_s="0.4"/></heat>
    <bumper segments="6"><noise chatter="0.1"/></bumper>
    <odometry><noise diameter_ratio="1.01" wheelbase_ratio="1.02" turn_slip_s="0.05" contact_slip="0.5"/></odometry>
    <compass><noise offset_deg="1" hard_iron_deg="5" hard_iron_at_deg="20" soft_iron_deg="2" soft_iron_at_deg="70"/></compass>
    <battery standing_h="0.01" driving_h="0.001"><noise drop_v_per_mps="0.3" drop_v_per_radps="0.1" std_v="0.01"/></battery>
    <battery standing_h="0.01" driving_h="0.001"/>
    <ground><at x_m="0.05"/><noise std="0.1"/></ground>
    <light range_max_m="4"><ring count="3" radius_m="0.2" z_m="0.1"/><noise std_lx="0.1"/></light>
    <omni_camera range_max_m="3" count="4"><noise dropout="0.1"/></omni_camera>
    <fiducial range_max_m="4" count="3" field_of_view_deg="180"><noise/></fiducial>
    <camera width_px="8" height_px="8" rate_hz="3"><ptz/></camera>
    <blob_finder><color name="gold" rgb="1 0.8 0.1"/></blob_finder>
  </sensors>
</robot>)";

/// Makes bytes that depend on the pose, between the marks of a JPEG file.
class PoseImages : public ImageSource {
 public:
  void take(const CameraView&, const SeenWorld& seen, std::span<const std::uint32_t> robots,
            std::span<std::string> jpegs) override {
    for (std::size_t i = 0; i < robots.size(); ++i) {
      jpegs[i] = "\xFF\xD8" + std::to_string(seen.world_from_robot[robots[i]].x) + "\xFF\xD9";
    }
  }
  /// Finds none.
  std::vector<Blob> findBlobs(const std::string&, const std::vector<TargetColor>& colors, unsigned) override {
    std::vector<Blob> blobs(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i) blobs[i].color = colors[i].name;
    return blobs;
  }
};

std::string nameOf(std::uint32_t robot) { return "r" + std::to_string(robot); }

/// Drives of some robots.
std::optional<XmlElement> driveOf(std::uint32_t robot) {
  const auto drive = [](std::vector<std::pair<std::string, std::string>> attributes) {
    return XmlElement{"drive", "", std::move(attributes), {}, {}};
  };
  if (robot % 4 == 1) return drive({{"type", "omni"}, {"lateral_max_mps", "0.7"}});
  if (robot % 4 == 3) return drive({{"type", "tracked"}, {"track_factor", "1.5"}, {"icr_x_m", "-0.05"}});
  return std::nullopt;
}

/// Three rows of robots with movable boxes in the rows, and walls and gold between them.
World randomWorld(Rng& rng) {
  World world = emptyWorld(4);
  world.communication = {
      .range_m = 6, .loss_probability = 0.1, .wall_range_m = 0.5, .wall_loss = 0.1, .burst_gap_s = 2};
  world.communication.burst_s = 0.5;
  world.communication.burst_loss = 0.9;
  world.communication.delay_s = 0.15;
  world.communication.rate_hz = 25;
  for (const double y_m : {-1.0, 1.0}) {
    for (int i = 0; i < 3; ++i) addWall(world, rng.uniform(-3, 3), y_m, rng.uniform(0.1, 1.5), 0.1);
  }
  addGold(world, rng.uniform(-3, 3), 1.5, 0.1);
  world.objects.front().body.light_cd = 3;
  world.objects.back().body.fiducial = 2;
  WorldObject nest = world.objects.back();
  nest.name = "nest";
  nest.body = {.shape = Cylinder{1}, .world_from_body = {}, .center_z_m = -0.1, .height_m = 0.2};
  world.objects.push_back(nest);
  addBox(world, {-1.25, -2.5, 0.3}, 0.4, 0.2, {.mass_kg = 2});
  addBox(world, {1.25, 0, 0}, 0.3, 0.3, {.mass_kg = 1, .friction = 0.02, .restitution = 0.7});
  addBox(world, {-1.25, 2.5, 1}, 0.5, 0.1, {.mass_kg = 8});
  for (std::uint32_t i = 0; i < ProbeRun::kRobots; ++i) {
    RobotPlacement placement;
    placement.name = nameOf(i);
    placement.model = "probe";
    placement.world_from_robot = {2.5 * (i % 3) - 2.5, 2.5 * (i / 3) - 2.5, rng.uniform(-3, 3)};
    placement.drive = driveOf(i);
    world.robots.push_back(placement);
  }
  return world;
}

/// Changes the run at random, in about one of six steps; impossible changes are refused.
void intervene(Environment& environment, Rng rng) {
  if (rng.below(6) != 0) return;
  const auto& objects = environment.objects();
  const std::string object = objects[rng.below(static_cast<std::uint32_t>(objects.size()))].name;
  const double x_m = rng.uniform(-4.2, 4.2), y_m = rng.uniform(-4.2, 4.2), heading_rad = rng.uniform(-3, 3);
  const auto change = [&]() -> Change {
    switch (rng.below(7)) {
      case 0:
        return PlaceBody{object, x_m, y_m, heading_rad};
      case 1:
        return PlaceBody{nameOf(rng.below(ProbeRun::kRobots)), x_m, y_m, heading_rad};
      case 2: {
        WorldObject added = objects.front();
        added.name = "added " + std::to_string(environment.time().step);
        added.body.world_from_body = {x_m, y_m, heading_rad};
        return AddObject{added};
      }
      case 3:
        if (objects.size() > 2) return RemoveBody{object};
        [[fallthrough]];
      case 4:
        return ChangeObject{object,        rng.below(2) * 30.0, {{0.1f, 0.2f, 0.3f}}, rng.uniform(0.1, 2),
                            rng.uniform(), {4.0, 5.0}};
      case 5:
        return ChangeActivity{nameOf(rng.below(ProbeRun::kRobots)), Activity::active};
      default: {
        Communication communication = environment.communication();
        communication.delay_s = rng.uniform(0, 0.4);
        communication.loss_probability = rng.uniform(0, 0.3);
        return ChangeRadio{communication};
      }
    }
  };
  static_cast<void>(environment.apply({"test", change()}));
}

}  // namespace

ProbeRun::ProbeRun(std::uint64_t seed) : seed_(seed), images_(std::make_unique<PoseImages>()) {
  Rng rng(seed);
  World world = randomWorld(rng);
  ErrorList errors;
  Fleet fleet = buildFleet(world, "probe_run.xml", {{"probe", {"probe.xml", kProbe}}}, {}, errors);
  errors.throwIfAny();
  environment_ = std::make_unique<Environment>(std::move(world), std::move(fleet),
                                               EnvironmentOptions{.seed = seed, .period_s = 0.1}, images_.get());
}

std::unique_ptr<Environment> ProbeRun::another(int threads) const {
  return std::make_unique<Environment>(environment_->model(), initialState(*environment_->model()), threads,
                                       images_.get());
}

void ProbeRun::step(Environment& environment) const {
  prepare(environment);
  environment.step();
}

void ProbeRun::prepare(Environment& environment) const {
  const std::uint64_t step = environment.time().step;
  for (std::uint32_t i = 0; i < kRobots; ++i) {
    Rng rng(seed_, RandomPurpose::test, i, 1, step);
    if (rng.below(4) == 0) {
      Command command{.speed_mps = rng.uniform(-0.5, 1.5),
                      .turn_radps = rng.uniform(-2, 2),
                      .laser_pan_rad = static_cast<float>(rng.uniform(-2, 2))};
      if (rng.below(2) == 0) command.lateral_mps = rng.uniform(-1, 1);
      if (rng.below(100) == 0) command.activity = Activity::halted;
      command.by_driver = rng.below(2) == 0;
      command.emergency_stop = rng.below(8) == 0;
      command.grip = command.by_driver != command.emergency_stop;
      if (command.by_driver) command.led_color = 0x10203 * i;
      if (rng.below(3) == 0) {
        command.camera_head =
            CameraHeadCommand{{rng.uniform(-2, 2), rng.uniform(-1, 2), rng.uniform(0, 20)}, rng.uniform(-1, 2), 0.5};
      }
      environment.setCommand(i, command);
    }
    for (std::uint32_t k = rng.below(3); k > 0; --k) {
      environment.send(i, nameOf(rng.below(kRobots)), "step " + std::to_string(step));
    }
    if (rng.below(5) == 0) environment.broadcast(i, "to all in step " + std::to_string(step));
    if (rng.below(30) == 0) environment.checkWin(i);
    const bool is_absent = environment.state().activity[i] == Activity::absent;
    if (!is_absent && rng.below(150) == 0) environment.remove(i);
    if (is_absent && rng.below(20) == 0) environment.enter(i);
  }
  intervene(environment, Rng(seed_, RandomPurpose::test, kRobots, 1, step));
}

std::uint32_t ProbeRun::random(std::uint32_t n) const { return Rng(seed_, RandomPurpose::test, 0, 2).below(n); }

}  // namespace robosim
