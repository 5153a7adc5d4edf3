#include "robosim_bench/umbmark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/xml_element.h"
#include "environment/environment.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

/// A Pioneer without anything that the experiment does not need.
std::string robotType(const UmbmarkOptions& options) {
  const auto setting = [](const char* name, double value) {
    return std::string(" ") + name + "=\"" + toText(value) + "\"";
  };
  const WheelErrors& w = options.wheels;
  const double scale = options.has_noise ? 1 : 0;
  return R"(<robot name="umbmark" help="Drives squares.">
  <body radius_m="0.267" height_m="0.237"/>
  <limits speed_max_mps="1" accel_mps2="0.3" decel_mps2="0.3" turn_max_degps="99.7" turn_accel_degps2="100"/>
  <sensors><odometry><noise)" +
         setting("diameter_ratio", w.diameter_ratio) + setting("wheelbase_ratio", w.wheelbase_ratio) +
         setting("wheelbase_m", w.wheelbase_m) + setting("turn_slip_s", w.turn_slip_s) +
         setting("contact_slip", w.contact_slip) + setting("length_std_per_sqrt_m", 0.002 * scale) +
         setting("turn_std_per_sqrt_rad", 0.002 * scale) + setting("drift_std_per_sqrt_m", 0.001 * scale) +
         "/></odometry></sensors></robot>";
}

LoadedWorld emptyWorld(const UmbmarkOptions& options) {
  LoadedWorld loaded;
  loaded.world.name = "umbmark";
  const double half_m = 2 * options.side_m + 2;
  loaded.world.bounds = {-half_m, half_m, -half_m, half_m};
  RobotPlacement robot;
  robot.name = "robot";
  robot.model = "umbmark";
  loaded.world.robots.push_back(robot);
  ErrorList errors;
  loaded.fleet =
      buildFleet(loaded.world, "umbmark.xml", {{"umbmark", {"umbmark.xml", robotType(options)}}}, {}, errors);
  errors.throwIfAny();
  return loaded;
}

/// Drives four sides and four corners by odometry, each to rest.
class SquareDriver {
 public:
  /// @param side +1: counter-clockwise, -1: clockwise
  SquareDriver(const UmbmarkOptions& options, int side) : options_(options), side_(side) {}

  /// The command for the next step; nullopt at the end.
  std::optional<Command> decide(const Odometry& now) {
    if (is_turning_ ? hasTurned(now) : hasArrived(now)) {
      if (is_turning_) ++corners_;
      is_turning_ = !is_turning_;
      if (corners_ == 4) return std::nullopt;
    }
    const double ahead_rad = corners_ * side_ * M_PI_2;  // heading of this side in the frame of odometry
    const double period_s = options_.period_s;
    if (is_turning_) {
      const double left_rad = std::remainder(ahead_rad + side_ * M_PI_2 - now.odom_from_robot.phi, 2 * M_PI);
      return Command{.turn_radps =
                         std::copysign(approach(std::abs(left_rad), options_.turn_radps, kTurnDecel), left_rad)};
    }
    const double off_rad = std::remainder(ahead_rad - now.odom_from_robot.phi, 2 * M_PI);
    // Proportional and integral, so that unequal wheels leave no constant deviation along a side.
    integral_radps_ += 2 * off_rad * period_s;
    return Command{.speed_mps = approach(remaining(now), options_.speed_mps, kDecel_mps2),
                   .turn_radps = 3 * off_rad + integral_radps_};
  }

 private:
  static constexpr double kDecel_mps2 = 0.2;
  static constexpr double kTurnDecel = 0.8;  ///< [rad/s²]
  static constexpr double kTolerance_m = 5e-4;
  static constexpr double kTolerance_rad = 5e-4;

  /// The largest speed that stops in time.
  double approach(double left, double speed_max, double decel) const {
    return std::min({speed_max, std::sqrt(2 * decel * left), left / options_.period_s / 2});
  }
  /// Distance to the end of this side, along it.
  double remaining(const Odometry& now) const {
    const mrpt::math::TPoint2D ends[] = {{1, 0}, {1, 1.0 * side_}, {0, 1.0 * side_}, {0, 0}};
    const double heading = corners_ * side_ * M_PI_2;
    const auto& end = ends[corners_];
    return std::max(0.0, (end.x * options_.side_m - now.odom_from_robot.x) * std::cos(heading) +
                             (end.y * options_.side_m - now.odom_from_robot.y) * std::sin(heading));
  }
  bool hasArrived(const Odometry& now) const { return remaining(now) < kTolerance_m && std::abs(now.speed_mps) < 0.01; }
  bool hasTurned(const Odometry& now) const {
    const double target_rad = (corners_ + 1) * side_ * M_PI_2;
    return std::abs(std::remainder(target_rad - now.odom_from_robot.phi, 2 * M_PI)) < kTolerance_rad &&
           std::abs(now.turn_radps) < 0.02;
  }

  UmbmarkOptions options_;
  int side_;
  int corners_ = 0;
  bool is_turning_ = false;
  double integral_radps_ = 0;
};

mrpt::math::TPoint2D errorOfRun(const UmbmarkOptions& options, int side, std::uint64_t seed) {
  LoadedWorld loaded = emptyWorld(options);
  Environment environment(std::move(loaded.world), std::move(loaded.fleet),
                          {.seed = seed, .period_s = options.period_s});
  SquareDriver driver(options, side);
  const auto odometry = [&] { return std::get<Odometry>(environment.state().readings[0].measurements[0]); };
  while (const auto command = driver.decide(odometry())) {
    environment.setCommand(0, *command);
    environment.step();
  }
  const auto& pose = environment.state().world_from_robot[0];
  const auto measured = odometry().odom_from_robot;
  return {pose.x - measured.x, pose.y - measured.y};
}

mrpt::math::TPoint2D computeMean(const std::vector<mrpt::math::TPoint2D>& points) {
  mrpt::math::TPoint2D sum;
  for (const auto& point : points) sum += point;
  return sum * (1.0 / static_cast<double>(points.size()));
}

/// Errors of the two directions: clockwise x, y, counter-clockwise x, y.
using Ends = std::array<double, 4>;

/// Ends of squares whose sides are arcs that turn by `beta_rad`, and whose corners lack `alpha_rad`.
Ends computeEnds(double alpha_rad, double beta_rad, double side_m) {
  const double chord_m = beta_rad == 0 ? side_m : side_m * std::sin(beta_rad / 2) / (beta_rad / 2);
  Ends ends{};
  for (const int turn : {-1, 1}) {
    double heading = 0;
    for (int i = 0; i < 4; ++i) {
      const std::size_t at = turn < 0 ? 0 : 2;
      ends[at] += chord_m * std::cos(heading + beta_rad / 2);
      ends[at + 1] += chord_m * std::sin(heading + beta_rad / 2);
      heading += beta_rad + turn * (M_PI_2 - alpha_rad);
    }
  }
  return ends;
}

/// Improves α and β by Gauss–Newton steps.
void refine(const Ends& measured, double side_m, double& alpha_rad, double& beta_rad) {
  constexpr double kDelta = 1e-6;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Ends now = computeEnds(alpha_rad, beta_rad, side_m);
    const Ends by_alpha = computeEnds(alpha_rad + kDelta, beta_rad, side_m);
    const Ends by_beta = computeEnds(alpha_rad, beta_rad + kDelta, side_m);
    double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double a = (by_alpha[i] - now[i]) / kDelta, b = (by_beta[i] - now[i]) / kDelta;
      const double residual = measured[i] - now[i];
      aa += a * a, ab += a * b, bb += b * b, ar += a * residual, br += b * residual;
    }
    const double determinant = aa * bb - ab * ab;
    alpha_rad += (bb * ar - ab * br) / determinant;
    beta_rad += (aa * br - ab * ar) / determinant;
  }
}

/// E_d: (R + b/2) / (R − b/2) with R = side/2 / sin(β/2), without an infinite radius.
double diameterRatio(double beta_rad, double side_m, double wheelbase_m) {
  const double half_over_radius = wheelbase_m * std::sin(beta_rad / 2) / side_m;
  return (1 + half_over_radius) / (1 - half_over_radius);
}

double wheelbaseRatio(double alpha_rad) { return M_PI_2 / (M_PI_2 - alpha_rad); }

}  // namespace

UmbmarkErrors driveUmbmark(const UmbmarkOptions& options) {
  UmbmarkErrors errors;
  for (int run = 0; run < options.runs; ++run) {
    const std::uint64_t seed = options.seed + 2 * static_cast<std::uint64_t>(run);
    errors.clockwise.push_back(errorOfRun(options, -1, seed));
    errors.counter_clockwise.push_back(errorOfRun(options, +1, seed + 1));
  }
  return errors;
}

UmbmarkResult UmbmarkResult::of(const UmbmarkErrors& errors, double side_m, double wheelbase_m) {
  UmbmarkResult r;
  r.clockwise_m = computeMean(errors.clockwise);
  r.counter_clockwise_m = computeMean(errors.counter_clockwise);
  r.error_max_m = std::max(r.clockwise_m.norm(), r.counter_clockwise_m.norm());
  r.alpha_rad = (r.clockwise_m.x + r.counter_clockwise_m.x) / (-4 * side_m);
  r.beta_rad = (r.clockwise_m.x - r.counter_clockwise_m.x) / (-4 * side_m);
  r.curve_radius_m = r.beta_rad == 0 ? std::numeric_limits<double>::infinity() : side_m / 2 / std::sin(r.beta_rad / 2);
  r.diameter_ratio = diameterRatio(r.beta_rad, side_m, wheelbase_m);
  r.wheelbase_ratio = wheelbaseRatio(r.alpha_rad);
  double alpha_rad = r.alpha_rad, beta_rad = r.beta_rad;
  refine({r.clockwise_m.x, r.clockwise_m.y, r.counter_clockwise_m.x, r.counter_clockwise_m.y}, side_m, alpha_rad,
         beta_rad);
  r.exact_wheelbase_ratio = wheelbaseRatio(alpha_rad);
  r.exact_diameter_ratio = diameterRatio(beta_rad, side_m, r.exact_wheelbase_ratio * wheelbase_m);
  return r;
}

}  // namespace robosim
