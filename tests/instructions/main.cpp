// Counts the instructions of fixed small loads, which makes a change of cost visible independently of other load:
//   robosim_instructions FILE            counts under callgrind, and fails if a count exceeds that in FILE, or if
//                                        errors of sensors cost more than their limits
//   robosim_instructions FILE --brief    the same of the short form, in half the time
//   robosim_instructions FILE --update   counts, and stores the counts in FILE
//   robosim_instructions --do TALLY      runs the loads once: the program that callgrind runs
#include <cstdint>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/temporary_directory.h"
#include "tests/instructions/counts.h"
#include "tests/instructions/loads.h"
#include "tests/scenarios/verifying.h"
#include "tests/stock_tools.h"

// In place of the function of libhwy, which a library of videos loads: it measures the clock when it is loaded, by an
// instruction that Valgrind refuses on processors that do not announce it.
namespace hwy::platform {
std::uint64_t TimerResolution();
std::uint64_t TimerResolution() { return 1; }
}  // namespace hwy::platform

namespace robosim {
namespace {

std::string compilerName() {
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
}

/// The variant of withVectors() (lib/foundation/base/vector_width.h) used on callgrind's processor, which is never the
/// widest.
std::string vectorsName() {
#ifdef __x86_64__
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return "x86-64-v4";
  if (__builtin_cpu_supports("avx2")) return "x86-64-v3";
  return "x86-64";
#else
  return "every processor";
#endif
}

/// Runs all loads and writes the number of units of each. Run under callgrind in one process, because starting a
/// program there takes longer than most loads.
void doAll(const std::string& tally, Form form) {
  std::ofstream out(tally);
  out << vectorsName() << '\n';
  for (const auto& load : instructionLoads(form)) {
    const InstructionWork work = load.prepare();
    robosimCounted(work.work);
    out << work.units << '\n';
  }
}

/// The instruction count of one callgrind profile.
double totalOf(const std::filesystem::path& profile) {
  std::ifstream in(profile);
  double total = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("totals: ", 0) == 0) total = std::stod(line.substr(8));
  }
  if (total == 0) throw std::runtime_error(profile.string() + ": callgrind counted nothing");
  return total;
}

InstructionCounts countAll(Form form) {
  const TemporaryDirectory folder;
  // One profile per return from robosimCounted(): profile.1, profile.2, …
  const ToolRun run = runTool(
      "valgrind --quiet --tool=callgrind --toggle-collect=robosimCounted --dump-after=robosimCounted "
      "--callgrind-out-file=profile '" +
          std::filesystem::read_symlink("/proc/self/exe").string() + "' --do tally" +
          (form == Form::brief ? " --brief" : ""),
      folder.path());
  if (run.exit_code != 0)
    throw std::runtime_error("could not count; check that valgrind is installed. Its output:\n" + run.output);
  InstructionCounts counts{.compiler = compilerName(), .vectors = "", .instructions = {}};
  std::ifstream tally(folder.path() / "tally");
  tally >> counts.vectors;
  int profile = 0;
  for (const auto& load : instructionLoads(form)) {
    double units = 0;
    tally >> units;
    counts.instructions[load.name] = totalOf(folder.path() / ("profile." + std::to_string(++profile))) / units;
  }
  return counts;
}

/// @return whether all counts are within limits
bool countAndCompare(const std::filesystem::path& file, bool update, Form form) {
  InstructionCounts kept = readCounts(file);
  const InstructionCounts now = countAll(form);
  if (form == Form::brief) {
    for (const auto& load : instructionLoads()) {
      if (!load.is_in_short_form) kept.instructions.erase(load.name);
    }
  }
  std::cout << toTable(now, kept);
  auto faults = listCostlyErrors(now);
  if (update) {
    writeCounts(file, now);
  } else {
    const auto growth = listGrowth(now, kept);
    faults.insert(faults.end(), growth.begin(), growth.end());
  }
  for (const auto& fault : faults) std::cout << fault << '\n';
  return faults.empty();
}

}  // namespace
}  // namespace robosim

int main(int argc, char** argv) {
  CLI::App program("Counts the instructions of fixed small loads with callgrind");
  std::string file;
  std::string tally;
  bool update = false, is_brief = false;
  program.add_option("FILE", file, "file with the stored counts");
  program.add_flag("--update", update, "store the new counts");
  program.add_flag("--brief", is_brief, "only the loads of the short form; all with ROBOSIM_VERIFY=1")
      ->excludes("--update");
  program.add_option("--do", tally,
                     "run the loads without counting, and write the number of units of each to this file");
  program.require_option(1, 3);
  CLI11_PARSE(program, argc, argv);
  const auto form = is_brief && !robosim::isVerifying() ? robosim::Form::brief : robosim::Form::whole;
  try {
    if (!tally.empty()) {
      robosim::doAll(tally, form);
      return 0;
    }
    return robosim::countAndCompare(file, update, form) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "robosim_instructions: " << error.what() << '\n';
    return 2;
  }
}
