#include "maze/controllers.h"

#include "control/controller.h"
#include "maze/coordinated_frontiers.h"
#include "maze/gold_finder.h"
#include "maze/gold_search.h"
#include "maze/heat_gradient.h"
#include "maze/market.h"
#include "maze/oracle.h"
#include "maze/pushing/box_pusher.h"
#include "maze/pushing/doorway.h"
#include "maze/pushing/forager.h"
#include "maze/pushing/soccer_player.h"
#include "maze/random_walk.h"
#include "maze/stigmergy.h"
#include "maze/wall_follower.h"
#include "maze/wander.h"

namespace robosim {
namespace {

/// Controller without commands, for robots that are obstacles or are driven otherwise.
class Still : public Controller {
 public:
  void step(Robot&) override {}
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Still>(*this); }
};

using Made = std::unique_ptr<Controller>;
using Setup = ControllerSetup;
using Values = ParameterValues;

const char* const kThreshold = "heat_threshold_celsius";

Parameter heatThreshold() { return {kThreshold, kGoldHeat_celsius, 0, 1e6, "°C", "heat above this means gold"}; }
Parameter meanLength() { return {"mean_length_m", 5, 0.1, 1000, "m", "mean length of the straight steps"}; }

Parameter wallDistance() {
  return {"distance_radii",
          WallFollowerOptions{}.distance_radii,
          0.5,
          10,
          "robot radii",
          "distance between the robot's edge and the wall"};
}

struct Needs {
  std::vector<SensorKind> sensors{SensorKind::odometry, SensorKind::heat};
  bool world = false;
};

/// Adds a search for gold: a controller that moves a robot until it has found the gold.
template <typename MakeMovement>
void addSearch(ControllerRegistry& registry, const std::string& name, const std::string& help,
               std::vector<Parameter> parameters, const MakeMovement& make, const Needs& needs = {}) {
  parameters.insert(parameters.begin(), heatThreshold());
  registry.add({name, help, needs.sensors, std::move(parameters),
                [make](const Setup& setup, const Values& values) -> Made {
                  return std::make_unique<GoldSearch>(make(setup, values), values[kThreshold]);
                },
                needs.world});
}

void addWalks(ControllerRegistry& registry) {
  addSearch(registry, "random_walk",
            "Searches for gold by a random walk: straight steps of exponential length, turns by random angles "
            "(Pearson 1905).",
            {meanLength()}, [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<RandomWalk>(setup, StepLength::exponential(values["mean_length_m"]));
            });
  addSearch(registry, "levy_walk",
            "Searches for gold by a Lévy walk: straight steps whose lengths follow a power law, turns by random angles "
            "(Viswanathan et al. 1999).",
            {{"exponent", 2, 1.1, 4, "", "of the power law; smaller means more long steps, 3 and more are diffusive"},
             {"min_length_m", 0.5, 0.01, 100, "m", "length of the shortest steps"},
             {"max_length_m", 50, 0.1, 10000, "m", "length at which steps are cut off"}},
            [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<RandomWalk>(
                  setup, StepLength::powerLaw(values["exponent"], values["min_length_m"], values["max_length_m"]));
            });
  addSearch(registry, "wall_search", "Searches for gold along the walls on its right, as wall_follower drives.",
            {wallDistance()},
            [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<WallFollower>(setup, WallFollowerOptions{values["distance_radii"]});
            },
            {.sensors = {SensorKind::odometry, SensorKind::heat, SensorKind::sonar}});
  addSearch(registry, "heat_gradient",
            "Ascends the gradient of heat to the gold (Fraenkel & Gunn 1940); without heat a random walk.",
            {meanLength()}, [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<HeatGradient>(setup, StepLength::exponential(values["mean_length_m"]),
                                                    GoldProtocol(values[kThreshold]).warm());
            });
  addSearch(registry, "stigmergy",
            "Searches for gold where its team has left the least virtual pheromone, which is sent by messages and "
            "evaporates (Wagner et al. 1999).",
            {{"evaporation_s", StigmergyOptions{}.evaporation_s, 1, 1e6, "s", "time in which pheromone decays to 1/e"},
             {"cell_m", StigmergyOptions{}.cell_m, 0.2, 10, "m", "side of the cells that are marked"}},
            [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<Stigmergy>(setup, StigmergyOptions{values["evaporation_s"], values["cell_m"]});
            });
  addSearch(registry, "oracle",
            "Drives the shortest path on the known map to the gold; the reference for the times of searches.", {},
            [](const Setup& setup, const Values& values) -> Made {
              return std::make_unique<Oracle>(setup, values[kThreshold]);
            },
            {.world = true});
}

void addTeams(ControllerRegistry& registry) {
  const std::vector<SensorKind> needs{SensorKind::odometry, SensorKind::heat};
  const Parameter share{"share_s", CoordinatedFrontiersOptions{}.share_s,
                        0.1,       1000,
                        "s",       "time between two messages with parts of the map"};
  registry.add({"coordinated_frontiers",
                "Explores frontiers as gold_finder, with maps and targets shared by messages (Burgard et al. 2005).",
                needs,
                {heatThreshold(),
                 {"range_m", CoordinatedFrontiersOptions{}.range_m, 0.1, 1000, "m",
                  "distance from another robot's target at which a place has its full utility"},
                 {"discount_m", CoordinatedFrontiersOptions{}.discount_m, 0, 1000, "m",
                  "length of a path that equals the lost utility of a place at another robot's target"},
                 share},
                [](const Setup& setup, const Values& values) -> Made {
                  return std::make_unique<CoordinatedFrontiers>(
                      setup, CoordinatedFrontiersOptions{values[kThreshold], values["range_m"], values["discount_m"],
                                                         values["share_s"]});
                }});
  registry.add({"market",
                "Explores frontiers as gold_finder, in regions that the robots auction by messages, with shared maps "
                "(Zlot et al. 2002).",
                needs,
                {heatThreshold(),
                 {"region_m", MarketOptions{}.region_m, 0.5, 100, "m", "side of the regions"},
                 {"lease_s", MarketOptions{}.lease_s, 1, 10000, "s", "time after which a region can be sold again"},
                 share},
                [](const Setup& setup, const Values& values) -> Made {
                  return std::make_unique<Market>(setup, MarketOptions{values[kThreshold], values["region_m"],
                                                                       values["lease_s"], values["share_s"]});
                }});
}

Parameter placeX(const char* name, const char* help) { return {name, 0, -1e6, 1e6, "m", help}; }

void addPushers(ControllerRegistry& registry) {
  registry.add({"forage",
                "Pushes low round objects into a nest.",
                {SensorKind::odometry, SensorKind::laser},
                {placeX("nest_x_m", "x of the nest's centre in the world"),
                 placeX("nest_y_m", "y of the nest's centre in the world"),
                 {"nest_radius_m", ForagerOptions{}.nest_radius_m, 0.2, 1000, "m", "radius of the nest"},
                 {"puck_radius_m", ForagerOptions{}.puck_radius_m, 0.02, 1, "m", "radius of the objects"},
                 {"speed_mps", ForagerOptions{}.speed_mps, 0.01, 10, "m/s", "speed"}},
                [](const Setup& setup, const Values& values) -> Made {
                  return std::make_unique<Forager>(setup, ForagerOptions{{values["nest_x_m"], values["nest_y_m"]},
                                                                         values["nest_radius_m"],
                                                                         values["puck_radius_m"],
                                                                         values["speed_mps"]});
                }});
  registry.add({"soccer",
                "Plays soccer in a team: the nearest player pushes the ball to the goal, the others cover.",
                {SensorKind::odometry, SensorKind::laser},
                {{"goal_x_m", SoccerOptions{}.goal_x_m, -100, 100, "m",
                  "x of the goal that it attacks in the world; its own goal is at the negative x"},
                 {"half_width_m", SoccerOptions{}.half_width_m, 1, 100, "m", "half the width of the pitch"},
                 {"goal_half_width_m", SoccerOptions{}.goal_half_width_m, 0.3, 100, "m", "half the width of a goal"},
                 {"corner_m", SoccerOptions{}.corner_m, 0, 100, "m", "length cut off the pitch's sides at its corners"},
                 {"ball_radius_m", SoccerOptions{}.ball_radius_m, 0.02, 1, "m", "radius of the ball"},
                 {"speed_mps", SoccerOptions{}.speed_mps, 0.1, 10, "m/s", "speed"},
                 {"keeper", 0, 0, 1, "", "1 for the player that keeps the goal"}},
                [](const Setup& setup, const Values& values) -> Made {
                  return std::make_unique<SoccerPlayer>(
                      setup, SoccerOptions{values["goal_x_m"], values["half_width_m"], values["goal_half_width_m"],
                                           values["corner_m"], values["ball_radius_m"], values["speed_mps"],
                                           values["keeper"] >= 0.5});
                }});
  registry.add({"push_together",
                "Drives to the box ahead, waits there for its team, and pushes it with them.",
                {SensorKind::odometry},
                {{"distance_m", BoxPusherOptions{}.distance_m, 0.01, 1000, "m", "distance by which the box is pushed"},
                 {"speed_mps", BoxPusherOptions{}.speed_mps, 0.01, 10, "m/s", "speed"},
                 {"team", 2, 1, 1000, "robots", "number of robots that push, this one included"}},
                [](const Setup&, const Values& values) -> Made {
                  return std::make_unique<BoxPusher>(
                      BoxPusherOptions{values["distance_m"], values["speed_mps"], static_cast<int>(values["team"])});
                }});
  const auto add_doorway = [&](const char* name, const char* help, const char* x, const char* y, bool is_holder) {
    registry.add(
        {name,
         help,
         {SensorKind::odometry},
         {placeX("x_m", x), placeX("y_m", y), {"speed_mps", DoorwayOptions{}.speed_mps, 0.01, 10, "m/s", "speed"}},
         [is_holder](const Setup& setup, const Values& values) -> Made {
           return std::make_unique<Doorway>(
               setup, DoorwayOptions{{values["x_m"], values["y_m"]}, values["speed_mps"], is_holder});
         }});
  };
  add_doorway("hold_door", "Stands in a doorway, so that the door stays open, until another robot has passed.",
              "x of its place in the doorway, in the world", "y of its place in the doorway, in the world", true);
  add_doorway("pass_door", "Waits until another robot holds a door open, and drives through.",
              "x of its place behind the door, in the world", "y of its place behind the door, in the world", false);
}

ControllerRegistry own() {
  ControllerRegistry registry;
  registry.add({"gold_finder",
                "Searches an unknown maze for gold, sends GOLD to its neighbour, and halts.",
                {SensorKind::odometry, SensorKind::heat},
                {heatThreshold()},
                [](const Setup& setup, const Values& parameters) -> Made {
                  return std::make_unique<GoldFinder>(setup, GoldFinderOptions{parameters[kThreshold]});
                }});
  registry.add({"wander",
                "Drives about at random and avoids what is near.",
                {},
                {},
                [](const Setup& setup, const Values&) -> Made { return std::make_unique<Wander>(setup); }});
  registry.add({"wall_follower",
                "Follows the wall on its right.",
                {SensorKind::sonar},
                {wallDistance()},
                [](const Setup& setup, const Values& parameters) -> Made {
                  return std::make_unique<WallFollower>(setup, WallFollowerOptions{parameters["distance_radii"]});
                }});
  registry.add({"still", "Does nothing.", {}, {}, [](const Setup&, const Values&) -> Made {
                  return std::make_unique<Still>();
                }});
  addWalks(registry);
  addTeams(registry);
  addPushers(registry);
  return registry;
}

}  // namespace

ControllerRegistry& controllers() {
  static ControllerRegistry registry = own();
  return registry;
}

}  // namespace robosim
