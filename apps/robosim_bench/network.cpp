#include <algorithm>
#include <charconv>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/network_run.h"
#include "robosim_bench/process.h"

namespace robosim {
namespace {

struct LayoutTarget {
  ProcessLayout layout;
  double min_steps_per_s = 0;  ///< target; 0 for none

  std::string text() const { return withCommas(layout.processes) + " × " + withCommas(layout.robots_each); }
};

constexpr LayoutTarget kStandardLayouts[] = {{{1, 1}, 10000}, {{10, 1}}, {{100, 1}, 300}, {{1, 1000}, 100}};

/// Parses a number of processes and robots such as "100x1". @throws CLI::ValidationError
LayoutTarget parseLayout(const std::string& word) {
  ProcessLayout layout;
  const auto* const end = word.data() + word.size();
  const auto [x, error] = std::from_chars(word.data(), end, layout.processes);
  const bool is_half_read = error == std::errc{} && x != end && *x == 'x';
  const auto [rest, error_of_robots] = std::from_chars(is_half_read ? x + 1 : end, end, layout.robots_each);
  const auto is_in_reach = [](std::size_t n) { return n >= 1 && n <= 10'000; };
  if (!is_half_read || error_of_robots != std::errc{} || rest != end || !is_in_reach(layout.processes) ||
      !is_in_reach(layout.robots_each)) {
    throw CLI::ValidationError("--crowd", "'" + word + "': must be PROCESSESxROBOTS_EACH, such as 100x1");
  }
  const auto* const known =
      std::find_if(std::begin(kStandardLayouts), std::end(kStandardLayouts), [&](const LayoutTarget& target) {
        return target.layout.processes == layout.processes && target.layout.robots_each == layout.robots_each;
      });
  return known == std::end(kStandardLayouts) ? LayoutTarget{layout} : *known;
}

struct NetworkArguments {
  std::vector<std::string> layouts;
  NetworkBench bench;
  bool json = false;
};

std::vector<LayoutTarget> selectedLayouts(const std::vector<std::string>& arguments) {
  std::vector<LayoutTarget> layouts(std::begin(kStandardLayouts), std::end(kStandardLayouts));
  if (!arguments.empty()) layouts.clear();
  for (const auto& word : arguments) layouts.push_back(parseLayout(word));
  return layouts;
}

void print(const ProcessLayout& layout, const NetworkFigures& figures) {
  const nlohmann::ordered_json line{{"processes", layout.processes},
                                    {"robots_each", layout.robots_each},
                                    {"steps_per_s", figures.steps_per_s},
                                    {"environment_cpu_us", figures.environment_cpu_us},
                                    {"robots_cpu_us", figures.robots_cpu_us}};
  std::cout << line.dump() << std::endl;
}

std::vector<std::string> rowOf(const LayoutTarget& target, const NetworkFigures& figures) {
  const auto rounded = [](double number) { return withCommas(static_cast<std::uint64_t>(number)); };
  return {target.text(), rounded(figures.steps_per_s),
          target.min_steps_per_s > 0 ? rounded(target.min_steps_per_s) : "–", rounded(figures.environment_cpu_us),
          rounded(figures.robots_cpu_us)};
}

void benchNetwork(const NetworkArguments& arguments) {
  const OtherLoad other_load;
  Rows rows{{"processes × robots", "steps/s", "target", "environment, µs", "each process, µs"}};
  for (const LayoutTarget& target : selectedLayouts(arguments.layouts)) {
    {
      Progress progress;
      if (progress.due()) progress.show(target.text() + " …");
    }
    NetworkBench bench = arguments.bench;
    bench.layout = target.layout;
    const NetworkFigures figures = measureNetwork(bench);
    if (arguments.json) {
      print(target.layout, figures);
    } else {
      rows.push_back(rowOf(target, figures));
    }
  }
  if (arguments.json) return;
  std::cout << table(rows) << "µs of CPU time per step and process. Other programs used "
            << fixed(other_load.processors(), 1) << " of " << OtherLoad::ofProcessors()
            << " processors during the measurement,\nwhich reduces steps/s.\n";
}

}  // namespace

void addNetworkBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("network", "Measure steps per second with robots in other processes");
  auto a = std::make_shared<NetworkArguments>();
  command->add_option("--crowd", a->layouts, "repeatable; default: 1x1, 10x1, 100x1 and 1x1000")
      ->type_name("PROCESSESxROBOTS_EACH");
  command
      ->add_option("--windows", a->bench.windows, "number of measurements of each, 1 to 1000; the median is reported")
      ->check(wholeNumberIn(1, 1000))
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_option("--window", a->bench.window_s, "duration of a measurement, seconds")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--one-by-one", a->bench.one_by_one,
                    "start a program per process instead of one 'robosim robot --apart' for all");
  auto* cert = command->add_option("--tls-cert", a->bench.tls_cert, "measure with TLS: a certificate for 127.0.0.1")
                   ->type_name("FILE")
                   ->check(fileName());
  command->add_option("--tls-key", a->bench.tls_key, "its key")->type_name("FILE")->check(fileName())->needs(cert);
  cert->needs("--tls-key");
  command->add_flag("--json", a->json, "print one JSON object per line");
  command->footer(
      "Each process is a 'robosim robot' on this machine, whose robots run 'wander' with 16 sonars and 30 infrareds.");
  command->callback([a] { benchNetwork(*a); });
}

}  // namespace robosim
