// `robosim fit` on real recordings (package mrpt-common) and on recordings of RoboSim.
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "calibration/confidence.h"
#include "calibration/scanner_fit.h"
#include "sensors/testing/single_robot_scene.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// SENA, a wheelchair with a SICK LMS 200 (361 beams, centimetres), in a building of the University of Málaga, 2006.
constexpr const char* kSena = "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
/// The same vehicle, never at rest: 37 scans in 9 s.
constexpr const char* kMoving = "/usr/share/mrpt/datasets/localization_demo.rawlog";

class Fit : public TestFolder {
 protected:
  static std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
};

struct Count {
  std::size_t hits = 0, trials = 0;
  double rate() const { return static_cast<double>(hits) / static_cast<double>(trials); }
  void add(const Count& other) {
    hits += other.hits;
    trials += other.trials;
  }
};

/// Largest difference that chance explains between the rate of a held-out half and that of a model: the model's rate
/// has the error of the other half, which it was fitted to and which has about as many trials, and that of the
/// simulation. A level of 1 % for the four comparisons of a recording together, two rates in each of two halves
/// (Bonferroni).
double chanceDifference(const Count& real, const Count& simulated) {
  const double rate = (real.rate() + simulated.rate()) / 2;
  const double per_trial = 2 / static_cast<double>(real.trials) + 1 / static_cast<double>(simulated.trials);
  return normalBound(0.01 / 4) * std::sqrt(rate * (1 - rate) * per_trial);
}

/// Compares a rate in each half, and in both together. There each half is held out once and fitted once, so that its
/// sampling error cancels, and what differs is what the model cannot reproduce.
void expectRates(const ScannerFit& fit, const char* what, const std::function<Count(const PairStatistics&)>& count) {
  Count all_real, all_simulated;
  for (const auto& fold : fit.folds) {
    const Count real = count(fold.real), simulated = count(fold.simulated);
    EXPECT_NEAR(simulated.rate(), real.rate(), chanceDifference(real, simulated)) << what;
    all_real.add(real);
    all_simulated.add(simulated);
  }
  EXPECT_NEAR(all_simulated.rate(), all_real.rate(), kRateTolerance) << what;
}

void expectAgreement(RestCriterion criterion) {
  const ScannerFit fit = fitScanner(kSena, "", criterion);
  for (std::size_t band = 0; band < kBands; ++band) {
    if (fit.real.differences_m[band].empty()) continue;
    EXPECT_LE(fit.computeKs(band), fit.computeKsBound(band)) << bandName(band);
  }
  expectRates(fit, "jumps", [](const PairStatistics& s) { return Count{s.jumps, s.compared}; });
  expectRates(fit, "changes of validity", [](const PairStatistics& s) { return Count{s.flips, s.beams}; });
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
  const auto marked = fit.out.find(" !");
  ASSERT_NE(marked, std::string::npos) << fit.out;
  EXPECT_EQ(fit.out.find(" !", marked + 1), std::string::npos) << "one of the halves: " << fit.out;
  EXPECT_NE(fit.out.find("! One half alone exceeds its bound: odd pairs at 0 … 2 m."), std::string::npos) << fit.out;
  const auto laser = sensorFrom(textOf(in("laser.xml")));
  EXPECT_EQ(laser->info().beams.size(), 361u);
  EXPECT_GT(laser->info().noise_std_m, 0.003);
  const std::string report = textOf(in("report.html"));
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("turned at unchanged odometry [°]"), std::string::npos);
  EXPECT_NE(report.find("(<strong>differs</strong>)"), std::string::npos);
  for (const char* reference : {"<script ", "<link", "src=", "href="}) {
    EXPECT_EQ(report.find(reference), std::string::npos) << reference;
  }
}

TEST_F(Fit, WritesAFileThatARobotTypeIncludes) {
  std::filesystem::create_directories(in("robots/sensors"));
  ASSERT_EQ(runProgram("fit '" + std::string(kSena) + "' -o " + quoted(in("robots/sensors/sick.xml"))).exit_code, 0);
  std::ofstream(in("robots/scanner.xml"))
      << "<robot name='scanner'><body radius_m='0.2' height_m='0.5'/><limits speed_max_mps='1' accel_mps2='1' "
         "decel_mps2='1' turn_max_degps='90' turn_accel_degps2='180'/>\n<sensors><odometry/>\n"
         "<include file='sensors/sick.xml' z_m='0.3' label='sick'/></sensors></robot>";
  const auto world = in("w.xml");
  std::ofstream(world) << "<world><surface><size><xmin>-3</xmin><xmax>3</xmax><ymin>-3</ymin><ymax>3</ymax></size>"
                          "<object><shape><robot><model>scanner</model><name>R</name><controller>still</"
                          "controller><x>0</x><y>0</y></robot></shape>"
                          "</object></surface></world>";
  const std::string run = "run " + quoted(world) + " --time 1";
  const Ended first = runProgram(run + " --record " + quoted(in("r.rawlog")));
  EXPECT_EQ(first.exit_code, 0) << first.err;
  const Ended replayed = runProgram("replay " + quoted(in("r.rawlog")) + " --check " + quoted(world));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err << "the recording contains the included sensor";
  const Ended checked = runProgram("check " + quoted(world));
  EXPECT_NE(checked.out.find("laser: noise; tail 0.03"), std::string::npos) << checked.out;
  const Ended refused = runProgram(run + " --record " + quoted(in("robots/sensors/sick.xml")));
  EXPECT_NE(refused.err.find("sick.xml, which this command reads"), std::string::npos) << refused.err;
  std::ofstream(in("robots/sensors/sick.xml")) << "<laser>\n<noise std_m='2'/></laser>";
  for (const std::string& command : {run, "check " + quoted(world), "check " + quoted(in("robots/scanner.xml"))}) {
    const Ended faulty = runProgram(command);
    EXPECT_EQ(faulty.exit_code, 1) << command;
    EXPECT_NE((faulty.out + faulty.err).find("robots/sensors/sick.xml:2: <noise std_m=\"2\">: must lie in [0, 1]"),
              std::string::npos)
        << faulty.out << faulty.err;
  }
}

/// A room with two walls and a Pioneer with these sensors.
std::string roomWith(const std::string& sensors) {
  return "<world><surface><type>smooth</type><size><xmin>-6</xmin><xmax>6</xmax><ymin>-6</ymin><ymax>6</ymax></size>"
         "<object><shape><primitive><cube><name>a</name><x>5</x><y>0</y><z>0.5</z><length>0.2</length><width>10</width>"
         "<height>1</height><direction>0.3</direction></cube></primitive></shape></object>"
         "<object><shape><primitive><cube><name>b</name><x>0</x><y>3.1</y><z>0.5</z><length>6</length>"
         "<width>0.2</width><height>1</height></cube></primitive></shape></object>"
         "<object><shape><robot><model>pioneer3dx</model><name>R</name><x>0</x><y>0</y><sensors>" +
         sensors + "</sensors></robot></shape></object></surface></world>";
}

TEST_F(Fit, RecoversTheErrorsOfARecordingOfRoboSimInBothFormats) {
  std::ofstream(in("room.xml")) << roomWith("<laser noise='lms200' z_m='0.2'><noise divergence_deg='0'/></laser>");
  for (const std::string format : {"obs", "sf"}) {
    const std::string run = "run " + quoted(in("room.xml")) + " --controller still --time 20 --record " +
                            quoted(in(format + ".rawlog")) + " --rawlog-format " + format;
    ASSERT_EQ(runProgram(run).exit_code, 0);
    const ScannerFit fit = fitScanner(in(format + ".rawlog"), "laser", RestCriterion::scans);
    EXPECT_EQ(fit.used.size(), 200u) << format;
    EXPECT_DOUBLE_EQ(fit.model.errors.quantum_m, 0.01);
    const LaserErrors& errors = fit.model.errors;
    EXPECT_NEAR(errors.tail * errors.tail_factor * errors.tail_factor, 0.03 * 6 * 6, 0.4) << "variance of the tail";
    EXPECT_NEAR(errors.outlier, 0.0007, 0.0004) << "56 jumps in 36,200 differences, standard error 7.5";
    for (const std::size_t band : {1u, 2u, 3u}) EXPECT_NEAR(fit.model.std_m[band], 0.005, 0.0005) << bandName(band);
    EXPECT_TRUE(fit.isAccepted()) << summaryOf(fit);
  }
}

/// Records a robot that drives about in a room for `time_s`.
void recordDrive(const std::filesystem::path& world, const std::filesystem::path& rawlog, const std::string& time_s) {
  std::ofstream(world) << roomWith(
      "<odometry/><laser z_m='0.2' beams='181' field_of_view_deg='180' range_max_m='20'>"
      "<noise std_m='0.02' dropout='0.02' outlier='0.01'/></laser>");
  const Ended run =
      runProgram("run " + quoted(world) + " --controller wander --time " + time_s + " --record " + quoted(rawlog));
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(Fit, BoundsTheErrorsOfARecordingOfRoboSimThatIsNeverAtRest) {
  recordDrive(in("room.xml"), in("drive.rawlog"), "20");
  const ScannerFit fit = fitScanner(in("drive.rawlog"), "laser", RestCriterion::scans);
  EXPECT_EQ(fit.basis, FitBasis::local_map);
  EXPECT_GT(fit.map_readings.matched, 100u);
  const LaserErrors& errors = fit.model.errors;
  // Noise of the reading, and of a point between two others (2/3 of the variance) of the mean of one to three scans:
  // √(1 + 2/3) to √(1 + 2/9) times 0.02 m, if the scans were aligned without error.
  for (const std::size_t band : {0u, 1u, 2u}) {
    const double std_m =
        fit.model.std_m[band] * std::sqrt(1 + errors.tail * (errors.tail_factor * errors.tail_factor - 1));
    EXPECT_GT(std_m, 0.02 * std::sqrt(1 + 2.0 / 9) * 0.97) << bandName(band);
    EXPECT_LT(std_m, 0.02 * std::sqrt(1 + 2.0 / 3)) << bandName(band);
  }
  EXPECT_EQ(errors.quantum_m, 0);
  EXPECT_EQ(errors.reach_m, 0) << "unknown from a drive";
  EXPECT_NEAR(errors.dropout, 0.02, 0.005) << "of 14,000 readings: standard error 0.0012";
  EXPECT_NEAR(errors.outlier, 0.01, 0.0035) << "of 14,000 readings: standard error 0.0008";
  EXPECT_TRUE(fit.isAccepted()) << summaryOf(fit);
}

TEST_F(Fit, DoesNotWriteAModelThatDiffersFromTheRecordingUnlessForced) {
  const std::string fit = "fit " + quoted(kMoving) + " -o " + quoted(in("laser.xml"));
  const Ended refused = runProgram(fit);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("laser.xml is not written; the figures marked with ! show where"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(in("laser.xml")));
  EXPECT_NE(refused.out.find(" !"), std::string::npos) << refused.out;
  EXPECT_EQ(runProgram(fit + " --force").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(in("laser.xml")));
}

TEST_F(Fit, StatesThatTheErrorsOfARecordingThatIsNeverAtRestAreUpperBounds) {
  const Ended fit = runProgram("fit " + quoted(kMoving) + " --force -o " + quoted(in("laser.xml")) + " --report " +
                               quoted(in("report.html")));
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const std::string bounds = "errors of the motion and of the map: upper bounds of the scanner's own errors";
  EXPECT_NE(fit.out.find("at rest   0 pairs of scans"), std::string::npos) << fit.out;
  EXPECT_NE(fit.out.find("the residuals of 36 scans about the map of the scans before them"), std::string::npos)
      << fit.out;
  EXPECT_NE(fit.out.find(bounds), std::string::npos) << fit.out;
  const std::string xml = textOf(in("laser.xml")), report = textOf(in("report.html"));
  EXPECT_NE(xml.find(bounds), std::string::npos) << xml;
  EXPECT_EQ(xml.find("reach_m="), std::string::npos) << xml;
  EXPECT_NE(report.find("Residuals of the scans of a drive"), std::string::npos);
  EXPECT_NE(report.find("upper bounds of the scanner's own.</strong>"), std::string::npos);
  const auto laser = sensorFrom(xml);
  EXPECT_EQ(laser->info().beams.size(), 361u);

  // The scanner is the type of SENA: 5 mm at rest.
  const ScannerFit fitted = fitScanner(kMoving, "", RestCriterion::scans);
  EXPECT_DOUBLE_EQ(fitted.model.errors.quantum_m, 0.01);
  for (std::size_t band = 0; band < kBands; ++band) {
    EXPECT_GT(fitted.model.std_m[band], 0.005) << bandName(band);
    EXPECT_LT(fitted.model.std_m[band], 0.020) << bandName(band);
  }
  for (std::size_t band = 1; band < kBands; ++band) {
    EXPECT_LE(fitted.computeKs(band), fitted.computeKsBound(band)) << bandName(band);
  }
  EXPECT_GT(fitted.map_model.z_hit, 0.94);
}

TEST_F(Fit, RefusesRecordingsThatCannotBeFitted) {
  const auto errorOf = [](const std::string& file, const std::string& options = "") {
    const Ended fit = runProgram("fit '" + file + "' " + options);
    EXPECT_EQ(fit.exit_code, 1);
    return fit.err;
  };
  recordDrive(in("room.xml"), in("short.rawlog"), "0.5");
  const std::string few = errorOf(in("short.rawlog").string());
  EXPECT_NE(few.find("pairs of scans at rest of 'R/laser', of 6 scans, and 5 scans that can be aligned with those "
                     "before them; 2 pairs or 10 aligned scans are required, so record the scanner while the robot "
                     "stands, or longer while it drives among walls"),
            std::string::npos)
      << few;
  EXPECT_NE(errorOf("/usr/share/mrpt/datasets/kf-slam_demo.rawlog").find("has no laser scans"), std::string::npos);
  EXPECT_NE(errorOf(kSena, "--sensor rear").find("--sensor rear: "), std::string::npos);
  std::ofstream(in("text.rawlog")) << "no recording, but a text that is long enough to have a header\n";
  EXPECT_NE(errorOf(in("text.rawlog").string()), "");
}

}  // namespace
}  // namespace robosim
