#include "environment/testing/small_world.h"

#include "sensors/odometry.h"

namespace robosim {

World emptyWorld(double half_m) {
  World world;
  world.name = "small";
  world.bounds = {-half_m, half_m, -half_m, half_m};
  return world;
}

void addWall(World& world, double x_m, double y_m, double length_m, double width_m, double turned_rad) {
  WorldObject wall;
  wall.name = "wall" + std::to_string(world.objects.size());
  wall.body.shape = Cube{length_m, width_m};
  wall.body.world_from_body = {x_m, y_m, turned_rad};
  wall.body.center_z_m = 0.5;
  wall.body.height_m = 1;
  world.objects.push_back(wall);
}

void addBox(World& world, const mrpt::math::TPose2D& at, double length_m, double width_m, const Movable& movable) {
  addWall(world, at.x, at.y, length_m, width_m, at.phi);
  WorldObject& box = world.objects.back();
  box.name = "box" + std::to_string(world.objects.size() - 1);
  box.movable = movable;
}

void addGold(World& world, double x_m, double y_m, double radius_m) {
  WorldObject gold;
  gold.name = "gold" + std::to_string(world.objects.size());
  gold.body.shape = Cylinder{radius_m};
  gold.body.world_from_body = {x_m, y_m, 0};
  gold.body.center_z_m = 0.25;
  gold.body.height_m = 0.5;
  gold.body.heat_celsius = 20;
  world.objects.push_back(gold);
}

void addDisc(World& world, Fleet& fleet, const std::string& name, const mrpt::math::TPose2D& start, double radius_m,
             const MotionLimits& limits) {
  auto model = std::make_shared<RobotModel>();
  model->name = "disc";
  model->body.shape = Cylinder{radius_m};
  model->body.center_z_m = 0.15;
  model->body.height_m = 0.3;
  model->radius_m = radius_m;
  model->limits = limits;
  model->sensors.push_back(makeOdometry({}));
  model->sensor_infos = std::make_shared<std::vector<SensorInfo>>(1, model->sensors[0]->info());
  model->type_info = RobotTypeInfo{model->name, limits, {}};

  FleetRobot robot;
  robot.info = {.name = name,
                .type = model->type_info,
                .neighbour = {},
                .radius_m = radius_m,
                .height_m = model->body.height_m,
                .sensors = model->sensor_infos};
  robot.model = model;
  robot.world_from_start = start;
  fleet.robots.push_back(robot);

  RobotPlacement placement;
  placement.name = name;
  placement.world_from_robot = start;
  world.robots.push_back(placement);
}

}  // namespace robosim
