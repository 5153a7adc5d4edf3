// Controller of robots in Stage 4 for `./dev bench peers`, which compiles it against an installed Stage: walks as
// RoboSim's controller `wander` does (lib/controller/maze/wander.cpp), and prints the first ranges of each robot.
// Not part of RoboSim's build.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <stage.hh>

namespace {

struct Walker {
  Stg::ModelPosition* robot;
  Stg::ModelRanger* ranger;
  std::mt19937 random;
  double radius_m = 0, speed_max_mps = 0, turn_max_radps = 0, decel_mps2 = 2;
  double turn = 0;  ///< fraction of turn_max_radps
  unsigned long now = 0, turn_until = 0;

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
};

void printRanges(const Walker& walker) {
  std::printf("READINGS %s", walker.robot->Token());
  for (const auto& sensor : walker.ranger->GetSensors()) std::printf(" %.9g", sensor.ranges.at(0));
  std::printf("\n");
}

int update(Stg::Model*, void* user) {
  Walker& walker = *static_cast<Walker*>(user);
  const auto& sensors = walker.ranger->GetSensors();
  if (sensors.empty() || sensors[0].ranges.empty()) return 0;
  if (walker.now == 0) printRanges(walker);
  const unsigned long now = ++walker.now;
  double left = 1e9, right = 1e9;
  for (const auto& sensor : sensors) {
    const double range = sensor.ranges[0];
    if (range >= sensor.range.max) continue;
    const double x = sensor.pose.x + range * std::cos(sensor.pose.a);
    const double y = sensor.pose.y + range * std::sin(sensor.pose.a);
    if (x <= 0 || std::abs(y) > 1.5 * walker.radius_m) continue;
    double& side = y >= 0 ? left : right;
    side = std::min(side, std::hypot(x, y) - walker.radius_m);
  }
  const double ahead = std::min(left, right);
  const bool is_stalled = walker.robot->Stalled();
  const bool is_near = ahead < 2 * walker.radius_m || is_stalled;
  if (now >= walker.turn_until || (is_near && std::abs(walker.turn) < 0.4)) {
    if (is_near) {
      walker.turn = std::copysign(walker.uniform(0.4, 0.9), left - right);
      walker.turn_until = now + 3 + walker.random() % 12;
    } else {
      walker.turn = walker.random() % 4 == 0 ? walker.uniform(-0.3, 0.3) : 0;
      walker.turn_until = now + 10 + walker.random() % 30;
    }
  }
  double speed = walker.speed_max_mps;
  if (is_near) {
    speed *= is_stalled ? 0 : std::clamp((ahead / walker.radius_m - 0.7) / 1.3, 0.0, 1.0) * 0.5;
  } else {
    speed = std::min(speed, std::sqrt(2 * walker.decel_mps2 * std::max(0.0, ahead - 0.7 * walker.radius_m)));
  }
  walker.robot->SetSpeed(speed, 0, walker.turn * walker.turn_max_radps);
  return 0;
}

}  // namespace

/// Called by Stage for each robot.
extern "C" int Init(Stg::Model* model, Stg::CtrlArgs*) {
  auto* const walker = new Walker;  // until the program ends
  walker->robot = dynamic_cast<Stg::ModelPosition*>(model);
  walker->ranger = dynamic_cast<Stg::ModelRanger*>(model->GetChild("ranger:0"));
  if (!walker->robot || !walker->ranger) return 1;
  walker->random.seed(model->GetId());
  walker->radius_m = model->GetGeom().size.x / 2;
  walker->speed_max_mps = walker->robot->velocity_bounds[0].max;
  walker->turn_max_radps = walker->robot->velocity_bounds[3].max;
  walker->ranger->AddCallback(Stg::Model::CB_UPDATE, update, walker);
  walker->ranger->Subscribe();
  walker->robot->Subscribe();
  return 0;
}
