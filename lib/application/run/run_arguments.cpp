#include "run/run_arguments.h"

#include <iostream>

#include "run/json_text.h"

namespace robosim {

bool RunArguments::timeIsUp(const SimTime& now) const {
  // Tolerance of half a step against rounding of the limit.
  return now.seconds() + now.period_s / 2 > time_s;
}

WorldSource readRunSource(const RunArguments& arguments) {
  WorldSource source = readWorldSource(arguments.world);
  source.seed = arguments.run.environment.seed;
  return withChanges(source, arguments.changes, arguments.run.environment.seed);
}

std::string whyNoAdditions(const RunArguments& arguments) {
  if (arguments.record.empty() || arguments.rawlog_format != "sf") return {};
  return "robots cannot be added to a run whose recording has a file for each robot; record observations "
         "(--rawlog-format obs)";
}

RunSummary summaryOf(const RunArguments& arguments, const LocalRun& run, EndedBy ended_by) {
  RunSummary summary = RunSummary::of(run);
  summary.world = arguments.world;
  summary.seed = arguments.run.environment.seed;
  summary.ended_by = ended_by;
  summary.depends_on_seed |= arguments.changes.has_random_starts || arguments.changes.random_robots > 0;
  summary.depends_on_seed |= run.environment().world().origin.is_scattered;
  return summary;
}

void printSummary(const RunSummary& summary, const RunArguments& arguments) {
  if (arguments.json) {
    std::cout << jsonText(summary.json()) << std::endl;
  } else {
    std::cout << summary.text();
  }
}

}  // namespace robosim
