// UMBmark: drives squares by odometry and estimates the errors of the wheels from where the robot ends.
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/angle_units.h"
#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/umbmark.h"

namespace robosim {
namespace {

struct OdometryArguments {
  UmbmarkOptions options{.wheels = {.diameter_ratio = 1.003, .wheelbase_ratio = 1.01}};
  bool no_noise = false;
  bool json = false;
};

double offBy(double recovered, double injected) {
  return injected == 1 ? 0 : 100 * (recovered - injected) / (injected - 1);
}

void benchOdometry(OdometryArguments arguments) {
  UmbmarkOptions& options = arguments.options;
  options.has_noise = !arguments.no_noise;
  const auto result = UmbmarkResult::of(driveUmbmark(options), options.side_m, options.wheels.wheelbase_m);
  const nlohmann::ordered_json figures{
      {"clockwise_m", {result.clockwise_m.x, result.clockwise_m.y}},
      {"counter_clockwise_m", {result.counter_clockwise_m.x, result.counter_clockwise_m.y}},
      {"error_max_m", result.error_max_m},
      {"alpha_deg", result.alpha_rad * kDegPerRad},
      {"beta_deg", result.beta_rad * kDegPerRad},
      {"curve_radius_m", result.curve_radius_m},
      {"diameter_ratio", result.diameter_ratio},
      {"diameter_ratio_injected", options.wheels.diameter_ratio},
      {"exact_diameter_ratio", result.exact_diameter_ratio},
      {"exact_diameter_ratio_off_percent", offBy(result.exact_diameter_ratio, options.wheels.diameter_ratio)},
      {"wheelbase_ratio", result.wheelbase_ratio},
      {"wheelbase_ratio_injected", options.wheels.wheelbase_ratio},
      {"exact_wheelbase_ratio", result.exact_wheelbase_ratio},
      {"exact_wheelbase_ratio_off_percent", offBy(result.exact_wheelbase_ratio, options.wheels.wheelbase_ratio)}};
  if (arguments.json) {
    std::cout << figures.dump() << std::endl;
    return;
  }
  const auto point = [](const mrpt::math::TPoint2D& p) { return "(" + fixed(p.x, 4) + ", " + fixed(p.y, 4) + ") m"; };
  const auto ratio = [](double injected, double of_paper, double exact) {
    return fixed(of_paper, 6) + " by the paper's equations, " + fixed(exact, 6) + " by exact arcs, " +
           fixed(injected, 6) + " injected; its deviation from 1 is off by " + fixed(offBy(of_paper, injected), 2) +
           " % and " + fixed(offBy(exact, injected), 2) + " %";
  };
  std::cout << listing(
      {{"clockwise", point(result.clockwise_m)},
       {"counter-clockwise", point(result.counter_clockwise_m)},
       {"E_max,syst", fixed(result.error_max_m, 4) + " m"},
       {"α, β", fixed(result.alpha_rad * kDegPerRad, 4) + "°, " + fixed(result.beta_rad * kDegPerRad, 4) + "°"},
       {"R", fixed(result.curve_radius_m, 2) + " m"},
       {"E_d", ratio(options.wheels.diameter_ratio, result.diameter_ratio, result.exact_diameter_ratio)},
       {"E_b", ratio(options.wheels.wheelbase_ratio, result.wheelbase_ratio, result.exact_wheelbase_ratio)}});
}

}  // namespace

void addOdometryBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand(
      "odometry",
      "UMBmark (Borenstein & Feng 1996): a robot drives squares by its odometry in both directions, and the errors at "
      "the ends give the ratios of its wheel diameters and its wheelbase, beside those injected");
  auto a = std::make_shared<OdometryArguments>();
  auto& o = a->options;
  command->add_option("--diameter-ratio", o.wheels.diameter_ratio, "E_d: right wheel by left wheel")
      ->check(numberIn(0.5, 2))
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_option("--wheelbase-ratio", o.wheels.wheelbase_ratio, "E_b: actual by nominal wheelbase")
      ->check(numberIn(0.5, 2))
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_option("--side", o.side_m, "side of the square")
      ->check(numberIn(0.5, 100))
      ->type_name("METRES")
      ->capture_default_str();
  command->add_option("--runs", o.runs, "runs in each direction")
      ->check(wholeNumberIn(1, 10000))
      ->capture_default_str();
  command->add_option("--seed", o.seed, "of the random errors in the first run")->capture_default_str();
  command->add_flag("--no-noise", a->no_noise, "systematic errors only");
  command->add_flag("--json", a->json, "print one JSON object");
  command->callback([a] { benchOdometry(*a); });
}

}  // namespace robosim
