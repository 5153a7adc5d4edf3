#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim {

/// Instructions a unit of each load, and what they were counted with: both decide how many there are.
struct InstructionCounts {
  std::string compiler;
  std::string vectors;  ///< which of the clones that the compiler makes for several processors ran
  std::map<std::string, double> instructions;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InstructionCounts, compiler, vectors, instructions)

/// By how much a load may grow before the test fails.
constexpr double kGrowthAllowed = 0.1;

/// What is wrong with `now` beside what is `kept`: a line for each load that has grown by more than kGrowthAllowed, or
/// is in only one of the two; and then one on how to mend it. Empty when all is well.
std::vector<std::string> growthOf(const InstructionCounts& now, const InstructionCounts& kept);

/// A row for each load of `now`: its count, and how it differs from the one `kept`.
std::string tableOf(const InstructionCounts& now, const InstructionCounts& kept);

/// Counts of a file; none when there is no such file.
/// @throws std::runtime_error when it holds something else
InstructionCounts readCounts(const std::filesystem::path& file);
/// @throws std::runtime_error when it cannot be written
void writeCounts(const std::filesystem::path& file, const InstructionCounts& counts);

}  // namespace robosim
