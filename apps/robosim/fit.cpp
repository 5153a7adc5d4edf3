#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/printable_text.h"
#include "calibration/scanner_fit.h"
#include "robosim/arguments.h"
#include "robosim/subcommands.h"
#include "run/output_files.h"

namespace robosim {
namespace {

struct FitArguments {
  std::string rawlog;
  std::string sensor;
  std::string output;
  std::string report;
  RestCriterion rest = RestCriterion::scans;
  bool is_forced = false;
};

void writeWhole(const std::string& file, const std::string& text) {
  AtomicFile out(file);
  out.write(text);
  out.commit();
}

void fit(const FitArguments& a) {
  refuseSameFile({{"RAWLOG", a.rawlog}, {"--output", a.output}, {"--report", a.report}});
  for (const auto& file : {a.output, a.report}) {
    if (!file.empty()) checkWritable(file);
  }
  const ScannerFit fitted = fitScanner(a.rawlog, a.sensor, a.rest);
  if (!a.report.empty()) writeWhole(a.report, reportHtml(fitted, a.rawlog));
  std::cout << printableLines(summaryOf(fitted));
  if (!fitted.isAccepted() && !a.is_forced) {
    throw ConfigError(
        a.rawlog + ": differs from the fitted model, so " +
        (a.output.empty() ? std::string("no <laser> is printed") : a.output + " is not written") +
        "; the figures marked with ! show where. Use a longer recording of a scanner at rest, or --force");
  }
  if (!a.output.empty()) writeWhole(a.output, modelXml(fitted, a.rawlog));
  if (a.output.empty()) std::cout << '\n' << printableLines(modelXml(fitted, a.rawlog));
}

}  // namespace

void addFit(CLI::App& program) {
  auto* command = addSubcommand(program, "fit");
  auto a = std::make_shared<FitArguments>();
  command
      ->add_option("RAWLOG", a->rawlog,
                   "a recording of a real robot with a laser scanner, best at rest: an MRPT rawlog, a bag of ROS 2 "
                   "(.mcap, .db3 or its folder), or a log of CARMEN (.log, .clf)")
      ->transform(inputFile(kRecordingKinds))
      ->type_name("FILE")
      ->required();
  command
      ->add_option(
          "--sensor", a->sensor,
          "label of the scanner, or its part after '/'; required if the recording has several; LABEL#1, LABEL#2 "
          "... for scanners of one label at different poses on the robot")
      ->type_name("LABEL");
  command->add_option("-o,--output", a->output, "write the errors as a <laser> element; default: print it")
      ->type_name("FILE")
      ->check(fileName());
  command->add_option("--report", a->report, "write the results with histograms as an HTML page")
      ->type_name("FILE")
      ->check(fileName());
  command->add_flag("--force", a->is_forced, "write the <laser> also if the recording differs from the fitted model");
  command
      ->add_option_function<std::string>(
          "--rest",
          [a](const std::string& text) {
            a->rest = text == "odometry" ? RestCriterion::odometry : RestCriterion::scans;
          },
          "scans: pairs at unchanged odometry whose scans do not contradict it; odometry: also pairs whose scans show "
          "that the robot rocked, so that this counts as an error of the scanner")
      ->check(CLI::IsMember({"scans", "odometry"}))
      ->type_name("scans|odometry")
      ->default_str("scans");
  command->footer(
      "Try:  robosim fit real.rawlog -o laser.xml --report laser.html\n"
      "A robot type includes the file in its <sensors>: <include file=\"laser.xml\" z_m=\"0.3\"/>\n"
      "Each pair of scans at rest is compared with simulated scans of a model that is fitted to the other half of the "
      "pairs; the written model is fitted to all. A recording without two such pairs is fitted to the residuals of its "
      "scans about the map of the scans before them, which also contain errors of the motion and of the map: upper "
      "bounds of the scanner's errors.");
  command->callback([a] { fit(*a); });
}

}  // namespace robosim
