// `robosim fit` on real recordings (package mrpt-common) and on recordings of RoboSim.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "calibration/scanner_fit.h"
#include "sensors/testing/single_robot_scene.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// SENA, a wheelchair with a SICK LMS 200 (361 beams, centimetres), in a building of the University of Málaga, 2006.
constexpr const char* kSena = "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
/// The same vehicle, never at rest.
constexpr const char* kMoving = "/usr/share/mrpt/datasets/localization_demo.rawlog";

class Fit : public TestFolder {
 protected:
  static std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
};

void expectAgreement(RestCriterion criterion) {
  const ScannerFit fit = fitScanner(kSena, "", criterion);
  for (std::size_t band = 0; band < kBands; ++band) {
    if (fit.real.differences_m[band].empty()) continue;
    EXPECT_LE(fit.ksOf(band), fit.ksBoundOf(band)) << bandName(band);
  }
  for (const auto& fold : fit.folds) {
    EXPECT_NEAR(fold.simulated.jumpRate(), fold.real.jumpRate(), kRateTolerance);
    EXPECT_NEAR(fold.simulated.flipRate(), fold.real.flipRate(), kRateTolerance);
  }
  EXPECT_TRUE(fit.isAccepted());
}

TEST_F(Fit, AgreesWithHeldOutPairsOfSenaAtRest) { expectAgreement(RestCriterion::scans); }

TEST_F(Fit, AgreesWithHeldOutPairsOfSenaAtUnchangedOdometry) { expectAgreement(RestCriterion::odometry); }

TEST_F(Fit, ExcludesThePairsInWhichTheWheelchairRocks) {
  const ScannerFit fit = fitScanner(kSena, "", RestCriterion::scans);
  EXPECT_EQ(fit.candidates.size(), 11u);
  for (const auto& pair : fit.candidates) EXPECT_EQ(pair.is_at_rest, pair.first < 7) << pair.first;
  EXPECT_DOUBLE_EQ(fit.model.errors.quantum_m, 0.01);
  EXPECT_GT(fit.model.std_m[0], 0.003);
  EXPECT_LT(fit.model.std_m[0], 0.010);
}

TEST_F(Fit, WritesAnElementThatARobotTypeAcceptsAndAReportWithoutExternalReferences) {
  const Ended fit = runProgram("fit '" + std::string(kSena) + "' -o " + quoted(in("laser.xml")) + " --report " +
                               quoted(in("report.html")));
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_NE(fit.out.find("7 pairs of scans; 4 excluded"), std::string::npos) << fit.out;
  EXPECT_NE(fit.out.find("The held-out pairs agree with the model."), std::string::npos) << fit.out;
  const auto laser = sensorFrom(textOf(in("laser.xml")));
  EXPECT_EQ(laser->info().beams.size(), 361u);
  EXPECT_GT(laser->info().noise_std_m, 0.003);
  const std::string report = textOf(in("report.html"));
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("standard errors) at unchanged odometry"), std::string::npos);
  for (const char* reference : {"<script", "<link", "src=", "href="}) {
    EXPECT_EQ(report.find(reference), std::string::npos) << reference;
  }
}

TEST_F(Fit, RefusesRecordingsThatCannotBeFitted) {
  const auto errorOf = [](const std::string& file, const std::string& options = "") {
    const Ended fit = runProgram("fit '" + file + "' " + options);
    EXPECT_EQ(fit.exit_code, 1);
    return fit.err;
  };
  EXPECT_NE(
      errorOf(kMoving).find("has 0 pairs of scans at rest of '', of 37 scans; at least two are required, so record "
                            "the scanner while the robot stands"),
      std::string::npos);
  EXPECT_NE(errorOf("/usr/share/mrpt/datasets/kf-slam_demo.rawlog").find("has no laser scans"), std::string::npos);
  EXPECT_NE(errorOf(kSena, "--sensor rear").find("--sensor rear: "), std::string::npos);
  std::ofstream(in("text.rawlog")) << "no recording, but a text that is long enough to have a header\n";
  EXPECT_NE(errorOf(in("text.rawlog").string()), "");
}

}  // namespace
}  // namespace robosim
