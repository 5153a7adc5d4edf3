// Counts the instructions of fixed small loads, so that a change in cost is seen however busy the machine is:
//   robosim_instructions FILE            counts under callgrind, and fails where more than FILE keeps
//   robosim_instructions FILE --update   counts, and keeps the counts in FILE
//   robosim_instructions --do TALLY      does the loads once: what callgrind runs
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/scratch_folder.h"
#include "tests/instructions/counts.h"
#include "tests/instructions/loads.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

std::string compilerName() {
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
}

/// Which clones of lib/geometry/vector_clones.h run on the processor that callgrind shows: never the widest.
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

/// Does all loads, and writes down of each how many units that was. What callgrind runs: it takes longer over the start
/// of a program than over most loads, so that all share one.
void doAll(const std::string& tally) {
  std::ofstream out(tally);
  out << vectorsName() << '\n';
  for (const auto& load : instructionLoads()) {
    const InstructionWork work = load.prepare();
    robosimCounted(work.work);
    out << work.units << '\n';
  }
}

/// What callgrind counted in one of its profiles.
double totalOf(const std::filesystem::path& profile) {
  std::ifstream in(profile);
  double total = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("totals: ", 0) == 0) total = std::stod(line.substr(8));
  }
  if (total == 0) throw std::runtime_error(profile.string() + ": callgrind counted nothing");
  return total;
}

InstructionCounts countAll() {
  const ScratchFolder folder;
  // A profile for each return from robosimCounted(): profile.1, profile.2, …
  const ToolRun run = runTool(
      "valgrind --quiet --tool=callgrind --toggle-collect=robosimCounted --dump-after=robosimCounted "
      "--callgrind-out-file=profile '" +
          std::filesystem::read_symlink("/proc/self/exe").string() + "' --do tally",
      folder.path());
  if (run.exit_code != 0) throw std::runtime_error("could not count; is valgrind installed? It said:\n" + run.output);
  InstructionCounts counts{.compiler = compilerName(), .vectors = "", .instructions = {}};
  std::ifstream tally(folder.path() / "tally");
  tally >> counts.vectors;
  int profile = 0;
  for (const auto& load : instructionLoads()) {
    double units = 0;
    tally >> units;
    counts.instructions[load.name] = totalOf(folder.path() / ("profile." + std::to_string(++profile))) / units;
  }
  return counts;
}

/// @return whether all is well
bool countAndCompare(const std::filesystem::path& file, bool update) {
  const InstructionCounts kept = readCounts(file);
  const InstructionCounts now = countAll();
  std::cout << tableOf(now, kept);
  if (update) {
    writeCounts(file, now);
    return true;
  }
  const auto faults = growthOf(now, kept);
  for (const auto& fault : faults) std::cout << fault << '\n';
  return faults.empty();
}

}  // namespace
}  // namespace robosim

int main(int argc, char** argv) {
  CLI::App program("Counts the instructions of fixed small loads with callgrind");
  std::string file;
  std::string tally;
  bool update = false;
  program.add_option("FILE", file, "the counts that are kept");
  program.add_flag("--update", update, "keep what is counted now");
  program.add_option("--do", tally, "do the loads, count nothing, and write how many units each was to this file");
  program.require_option(1, 2);
  CLI11_PARSE(program, argc, argv);
  try {
    if (!tally.empty()) {
      robosim::doAll(tally);
      return 0;
    }
    return robosim::countAndCompare(file, update) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "robosim_instructions: " << error.what() << '\n';
    return 2;
  }
}
