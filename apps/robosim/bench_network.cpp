#include <algorithm>
#include <charconv>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "robosim/arguments.h"
#include "robosim/bench_crowd.h"
#include "robosim/bench_process.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

struct AimedCrowd {
  CrowdSize crowd;
  double aim_steps_per_s = 0;  ///< 0 for none

  std::string text() const { return withCommas(crowd.processes) + " × " + withCommas(crowd.robots_each); }
};

constexpr AimedCrowd kCrowds[] = {{{1, 1}, 10000}, {{10, 1}}, {{100, 1}, 300}, {{1, 1000}, 100}};

/// A crowd as one names it on the command line: "100x1". @throws CLI::ValidationError for what is none
AimedCrowd crowdOf(const std::string& word) {
  CrowdSize crowd;
  const auto* const end = word.data() + word.size();
  const auto [x, error] = std::from_chars(word.data(), end, crowd.processes);
  const bool is_half_read = error == std::errc{} && x != end && *x == 'x';
  const auto [rest, error_of_robots] = std::from_chars(is_half_read ? x + 1 : end, end, crowd.robots_each);
  const auto is_in_reach = [](std::size_t n) { return n >= 1 && n <= 10'000; };
  if (!is_half_read || error_of_robots != std::errc{} || rest != end || !is_in_reach(crowd.processes) ||
      !is_in_reach(crowd.robots_each)) {
    throw CLI::ValidationError("--crowd", "'" + word + "' is no crowd; name processes and robots in each, 100x1 say");
  }
  const auto* const known = std::find_if(std::begin(kCrowds), std::end(kCrowds), [&](const AimedCrowd& aimed) {
    return aimed.crowd.processes == crowd.processes && aimed.crowd.robots_each == crowd.robots_each;
  });
  return known == std::end(kCrowds) ? AimedCrowd{crowd} : *known;
}

struct Arguments {
  std::vector<std::string> crowds;
  CrowdBench bench;
  bool json = false;
};

std::vector<AimedCrowd> wanted(const std::vector<std::string>& words) {
  std::vector<AimedCrowd> crowds(std::begin(kCrowds), std::end(kCrowds));
  if (!words.empty()) crowds.clear();
  for (const auto& word : words) crowds.push_back(crowdOf(word));
  return crowds;
}

void print(const CrowdSize& crowd, const CrowdFigures& figures) {
  const nlohmann::ordered_json line{{"processes", crowd.processes},
                                    {"robots_each", crowd.robots_each},
                                    {"steps_per_s", figures.steps_per_s},
                                    {"environment_cpu_us", figures.environment_cpu_us},
                                    {"robots_cpu_us", figures.robots_cpu_us}};
  std::cout << line.dump() << std::endl;
}

std::vector<std::string> rowOf(const AimedCrowd& aimed, const CrowdFigures& figures) {
  const auto rounded = [](double number) { return withCommas(static_cast<std::uint64_t>(number)); };
  return {aimed.text(), rounded(figures.steps_per_s), aimed.aim_steps_per_s > 0 ? rounded(aimed.aim_steps_per_s) : "–",
          rounded(figures.environment_cpu_us), rounded(figures.robots_cpu_us)};
}

void benchNetwork(const Arguments& arguments) {
  const Company company;
  Rows rows{{"processes × robots", "steps/s", "to reach", "environment, µs", "each process, µs"}};
  for (const AimedCrowd& aimed : wanted(arguments.crowds)) {
    {
      Progress progress;
      if (progress.due()) progress.show(aimed.text() + " …");
    }
    CrowdBench bench = arguments.bench;
    bench.crowd = aimed.crowd;
    const CrowdFigures figures = benchCrowd(bench);
    if (arguments.json) {
      print(aimed.crowd, figures);
    } else {
      rows.push_back(rowOf(aimed, figures));
    }
  }
  if (arguments.json) return;
  std::cout << table(rows) << "µs are of CPU time, for each step and process. Other programs kept "
            << fixed(company.processors(), 1) << " of " << Company::ofProcessors()
            << " processors busy meanwhile;\nthe more, the worse are steps/s.\n";
}

}  // namespace

void addBenchNetwork(CLI::App& bench) {
  auto* command = bench.add_subcommand("network", "How many steps a second robots in other processes can follow");
  auto a = std::make_shared<Arguments>();
  command
      ->add_option("--crowd", a->crowds,
                   "may be given several times; without, 1x1, 10x1, 100x1 and 1x1000 are measured")
      ->type_name("PROCESSESxROBOTS_EACH");
  command->add_option("--windows", a->bench.windows, "how many times to measure each; the median is told")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--window", a->bench.window_s, "seconds to measure for each time")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--one-by-one", a->bench.one_by_one,
                    "start a program for each process, rather than one 'robosim robot --apart' for all");
  auto* cert = command->add_option("--tls-cert", a->bench.tls_cert, "measure with TLS: a certificate for 127.0.0.1")
                   ->type_name("FILE")
                   ->check(fileName());
  command->add_option("--tls-key", a->bench.tls_key, "its key")->type_name("FILE")->check(fileName())->needs(cert);
  cert->needs("--tls-key");
  command->add_flag("--json", a->json, "print one JSON object a line");
  command->footer(
      "Each process is a 'robosim robot' on this machine, whose robots wander with 16 sonars and 30 infrareds.");
  command->callback([a] { benchNetwork(*a); });
}

}  // namespace robosim
