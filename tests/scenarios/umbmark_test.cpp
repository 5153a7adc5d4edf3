// UMBmark recovers the errors of odometry that a robot type injects.
#include "robosim_bench/umbmark.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

UmbmarkResult recovered(const UmbmarkOptions& options) {
  return UmbmarkResult::of(driveUmbmark(options), options.side_m, options.wheels.wheelbase_m);
}

TEST(Umbmark, ReturnsToTheStartWithoutErrors) {
  const auto result = recovered({.wheels = {}, .runs = 1, .has_noise = false});
  EXPECT_NEAR(result.error_max_m, 0, 1e-9);
  EXPECT_NEAR(result.diameter_ratio, 1, 1e-9);
  EXPECT_NEAR(result.wheelbase_ratio, 1, 1e-9);
}

TEST(Umbmark, ConvertsCentresOfGravityByTheEquationsOfThePaper) {
  // α = (-0.08 - 0.08) / (-4 · 4) = 0.01 and β = (-0.08 + 0.08) / … = 0: wheelbase only.
  const auto wheelbase = UmbmarkResult::of({{{-0.08, -0.08}}, {{-0.08, 0.08}}}, 4, 0.4);
  EXPECT_NEAR(wheelbase.alpha_rad, 0.01, 1e-12);
  EXPECT_NEAR(wheelbase.beta_rad, 0, 1e-12);
  EXPECT_NEAR(wheelbase.wheelbase_ratio, M_PI_2 / (M_PI_2 - 0.01), 1e-12);
  EXPECT_NEAR(wheelbase.error_max_m, 0.08 * std::sqrt(2), 1e-12);
  // β = (-0.16 - 0.16) / (-4 · 4) = 0.02: R = 2 / sin 0.01 = 200.003, E_d = (R + 0.2) / (R - 0.2) = 1.002002.
  const auto diameters = UmbmarkResult::of({{{-0.16, -0.16}}, {{0.16, -0.16}}}, 4, 0.4);
  EXPECT_NEAR(diameters.alpha_rad, 0, 1e-12);
  EXPECT_NEAR(diameters.beta_rad, 0.02, 1e-12);
  EXPECT_NEAR(diameters.curve_radius_m, 200.00333, 1e-5);
  EXPECT_NEAR(diameters.diameter_ratio, 1.002002, 1e-6);
}

TEST(Umbmark, RecoversInjectedErrorsWithinFivePercentOfTheirDeviation) {
  for (const auto& [diameters, wheelbase] : {std::pair{1.003, 1.01}, {0.997, 1.02}, {1.01, 0.97}, {0.99, 1.05}}) {
    UmbmarkOptions options{.wheels = {.diameter_ratio = diameters, .wheelbase_ratio = wheelbase}};
    options.has_noise = false;
    options.runs = 1;
    const auto result = recovered(options);
    EXPECT_NEAR(result.exact_diameter_ratio - 1, diameters - 1, 0.05 * std::abs(diameters - 1));
    EXPECT_NEAR(result.exact_wheelbase_ratio - 1, wheelbase - 1, 0.05 * std::abs(wheelbase - 1));
  }
}

TEST(Umbmark, RecoversThemFromFiveRunsEachWayAmongRandomErrors) {
  const UmbmarkOptions options{.wheels = {.diameter_ratio = 1.003, .wheelbase_ratio = 1.01}};
  const auto result = recovered(options);
  EXPECT_NEAR(result.exact_diameter_ratio - 1, 0.003, 0.05 * 0.003);
  EXPECT_NEAR(result.exact_wheelbase_ratio - 1, 0.01, 0.05 * 0.01);
}

}  // namespace
}  // namespace robosim
