#include <cmath>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/recorded_run.h"

namespace robosim {
namespace {

struct RecordingArguments {
  RunToRecord run = smallRun();
  double min_s = 1;
  bool json = false;
};

void benchRecordings(const RecordingArguments& arguments) {
  RecordingFigures figures;
  {
    Progress progress;
    if (progress.due()) progress.show("the run with and without a recording …");
    figures = benchRecording(arguments.run, arguments.min_s);
  }
  if (arguments.json) {
    std::cout << nlohmann::json(figures).dump() << std::endl;
    return;
  }
  const auto row = [&](const char* name, const Cost& cost, double bytes) -> std::vector<std::string> {
    const auto more = [](double recorded, double plain) { return fixed(100 * (recorded / plain - 1), 0) + " %"; };
    return {name, fixed(1e6 * cost.cpu_s, 1), more(cost.cpu_s, figures.plain.cpu_s),
            more(cost.wall_s, figures.plain.wall_s), withCommas(static_cast<std::uint64_t>(std::llround(bytes)))};
  };
  std::cout << table({{"recording", "µs of CPU time", "more CPU time", "more wall time", "bytes"},
                      {"none", fixed(1e6 * figures.plain.cpu_s, 1), "–", "–", "–"},
                      row(".rawlog", figures.rawlog, figures.rawlog_bytes),
                      row(".mcap", figures.mcap, figures.mcap_bytes)})
            << "per simulated second\n";
}

}  // namespace

void addRecordingBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("recording", "Measure what recording adds to the time of a run");
  auto a = std::make_shared<RecordingArguments>();
  command->add_option("WORLD", a->run.world, "world file; default: the shipped opho2_1.xml")->type_name("FILE");
  command->add_option("--controller", a->run.controller, "controller of all robots; default: as given in the world")
      ->type_name("NAME");
  command->add_option("--time", a->run.time_s, "maximum simulated time [s]")
      ->check(numberIn(0.1, 1e6))
      ->type_name("SECONDS")
      ->capture_default_str();
  addMinTime(*command, "the run of each kind", a->min_s);
  command->add_flag("--json", a->json, "print a JSON object");
  command->footer(
      "The same run with no recording, a rawlog and an MCAP file, which are written to memory.\n"
      "CPU time is that of all threads.");
  command->callback([a] { benchRecordings(*a); });
}

}  // namespace robosim
