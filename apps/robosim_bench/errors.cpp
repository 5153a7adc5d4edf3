// Cost of the errors of sensors: robot-steps of the workload `sonar` with each of them, relative to exact sensors.
#include <iostream>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/robots.h"

namespace robosim {
namespace {

struct ErrorsArguments {
  std::size_t robots = 1000;
  double min_s = 1;
  bool json = false;
};

/// Errors of the workload's sonars, and further sensors.
struct ErrorLoad {
  const char* name;
  const char* help;
  const char* set;     ///< attributes of <sonar>
  const char* noise;   ///< attributes of its <noise>; null for none
  const char* others;  ///< further sensors, and the odometry in place of the workload's
};

constexpr const char* kExactOthers =
    "<compass/><heat/><bumper/><battery/><infrared><ring count='8' radius_m='0.2' z_m='0.1'/></infrared>";
constexpr const char* kNoisyOthers =
    "<odometry><noise diameter_ratio='1.003' wheelbase_ratio='1.01' turn_slip_s='0.01' contact_slip='0.3'/></odometry>"
    "<compass><noise offset_deg='1' hard_iron_deg='5' soft_iron_deg='2'/></compass><heat><noise lag_s='1'/></heat>"
    "<bumper><noise chatter='0.05'/></bumper><battery><noise drop_v_per_mps='0.3' std_v='0.01'/></battery>"
    "<infrared noise='gp2d12'><noise dropout='0.01'/><ring count='8' radius_m='0.2' z_m='0.1'/></infrared>";

constexpr ErrorLoad kErrorLoads[] = {
    {"exact", "none", "", nullptr, ""},
    {"gaussian", "std_per_m", "", "specular_deg='180'", ""},
    {"specular", "std_per_m, specular_deg: <noise/> alone", "", "", ""},
    {"lobe", "std_per_m, lobe", "", "wall_deg='42' far_deg='12.9' edge_share='0.5'", ""},
    {"second", "std_per_m, lobe, second_echoes", "", "wall_deg='42' far_deg='12.9' edge_share='0.5' second_echoes='1'",
     ""},
    {"blanking", "std_per_m, blanking_m, ringing", "", "specular_deg='180' blanking_m='0.15' ringing='0.001'", ""},
    {"crosstalk", "std_per_m, crosstalk", "", "specular_deg='180' crosstalk='0.01'", ""},
    {"interference", "std_per_m, robot_crosstalk", "", "specular_deg='180' robot_crosstalk='0.02'", ""},
    {"firing", "firing_interval_s", "firing_interval_s='0.04'", nullptr, ""},
    {"polaroid", "noise=\"polaroid\"", "noise='polaroid'", nullptr, ""},
    {"polaroid_firing", "noise=\"polaroid\", firing_interval_s", "noise='polaroid' firing_interval_s='0.04'", nullptr,
     ""},
    {"others_exact", "exact sonars, compass, heat, bumper, battery, 8 infrared beams", "", nullptr, kExactOthers},
    {"all", "all of these sensors with all errors", "noise='polaroid' firing_interval_s='0.04'", nullptr,
     kNoisyOthers}};

std::string sensorsOf(const ErrorLoad& load) {
  std::string sensors = std::string("<sonar model='rays' rays='1' range_max_m='5' ") + load.set +
                        "><ring count='16' radius_m='0.2' z_m='0.2'/>";
  if (load.noise) sensors += std::string("<noise ") + load.noise + "/>";
  return sensors + "</sonar>" + load.others;
}

void benchErrors(const ErrorsArguments& arguments) {
  std::vector<std::string> sensors;
  for (const auto& load : kErrorLoads) sensors.push_back(sensorsOf(load));
  std::vector<Workload> workloads;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    workloads.push_back({kErrorLoads[i].name, kErrorLoads[i].help, sensors[i].c_str(), 16});
  }
  std::vector<RobotLoad> loads;
  for (const auto& workload : workloads) loads.push_back({&workload, arguments.robots, 1});
  const auto costs = compareRobots(loads, 1, arguments.min_s);
  Rows rows{{"errors", "", "robot-steps/s of CPU time", "cost relative to exact"}};
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double ratio = costs[i].cpu_s / costs[0].cpu_s;
    if (arguments.json) {
      std::cout << nlohmann::ordered_json{{"errors", workloads[i].name},
                                          {"robots", arguments.robots},
                                          {"cpu_s_per_robot_step", costs[i].cpu_s},
                                          {"cost_ratio", ratio}}
                       .dump()
                << std::endl;
    }
    rows.push_back({workloads[i].name, workloads[i].help, withCommas(static_cast<std::uint64_t>(1 / costs[i].cpu_s)),
                    fixed(ratio, 2)});
  }
  if (!arguments.json) std::cout << table(rows);
}

}  // namespace

void addErrorsBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand(
      "errors",
      "Cost of the errors of sonars and other sensors: robot-steps of the workload sonar with each of them, "
      "relative to exact sensors, measured alternately by one thread");
  auto a = std::make_shared<ErrorsArguments>();
  command->add_option("--robots", a->robots, "number of robots")
      ->check(wholeNumberIn(1, 100000))
      ->capture_default_str();
  addMinTime(*command, "each row", a->min_s);
  command->add_flag("--json", a->json, "print one JSON object per row");
  command->callback([a] { benchErrors(*a); });
}

}  // namespace robosim
