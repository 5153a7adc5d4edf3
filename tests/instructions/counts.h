#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim {

/// Instructions per unit of each load, and the compiler and processor variant that they depend on.
struct InstructionCounts {
  std::string compiler;
  std::string vectors;  ///< variant of the function clones (vector_clones.h) that ran
  std::map<std::string, double> instructions;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InstructionCounts, compiler, vectors, instructions)

/// Relative growth of a load's count that the test allows.
constexpr double kGrowthAllowed = 0.1;

/// Compares counts: a line for each load of `now` that exceeds `kept` by more than kGrowthAllowed, or that is in only
/// one of the two; then a line on how to fix it. Empty if there is no difference.
std::vector<std::string> listGrowth(const InstructionCounts& now, const InstructionCounts& kept);

/// Compares the loads with errors of sensors with what those without took when the limits were set (November 2026): a
/// line for each that exceeds its limit, which is 2.5 times for "…, Gaussian noise" and 5 times for "…, all errors" and
/// what follows it. Such a load of an unknown "…" is a fault, too.
std::vector<std::string> listCostlyErrors(const InstructionCounts& now);

/// A table row for each load of `now`: its count, and the difference from `kept`.
std::string toTable(const InstructionCounts& now, const InstructionCounts& kept);

/// Reads counts from a file; empty when there is no such file.
/// @throws std::runtime_error for an invalid file
InstructionCounts readCounts(const std::filesystem::path& file);
/// @throws std::runtime_error when it cannot be written
void writeCounts(const std::filesystem::path& file, const InstructionCounts& counts);

}  // namespace robosim
