#include "tests/instructions/counts.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "base/text_table.h"
#include "tests/instructions/loads.h"

namespace robosim {
namespace {

std::string numberText(double count) { return withCommas(static_cast<std::uint64_t>(std::llround(count))); }

std::string percentText(double now, double kept) {
  const std::string percent = fixed(100 * (now / kept - 1), 1);
  if (percent == "-0.0" || percent == "0.0") return "0.0 %";
  return (now > kept ? "+" : "") + percent + " %";
}

const char* unitOf(const std::string& name) {
  const auto loads = instructionLoads();
  const auto load = std::find_if(loads.begin(), loads.end(), [&](const auto& l) { return name == l.name; });
  return load == loads.end() ? "unit" : load->unit;
}

}  // namespace

std::vector<std::string> listGrowth(const InstructionCounts& now, const InstructionCounts& kept) {
  std::vector<std::string> faults;
  for (const auto& [name, count] : now.instructions) {
    const auto before = kept.instructions.find(name);
    if (before == kept.instructions.end()) {
      faults.push_back(name + ": there is no count to compare with");
    } else if (count > before->second * (1 + kGrowthAllowed)) {
      faults.push_back(name + ": " + numberText(count) + " instructions a " + unitOf(name) + ", which is " +
                       percentText(count, before->second) + " on the " + numberText(before->second) +
                       " that are kept; +" + fixed(100 * kGrowthAllowed, 0) + " % is allowed");
    }
  }
  for (const auto& [name, count] : kept.instructions) {
    if (!now.instructions.count(name)) faults.push_back(name + ": a count is kept, but there is no such load");
  }
  if (faults.empty()) return faults;
  if (now.compiler != kept.compiler || now.vectors != kept.vectors) {
    faults.push_back("The counts that are kept are of " + kept.compiler + " for " + kept.vectors + ", these of " +
                     now.compiler + " for " + now.vectors + ": they may differ for that reason alone.");
  }
  faults.emplace_back("If what was gained is worth it, keep the new counts: ./dev bench --instructions --update");
  return faults;
}

std::vector<std::string> listCostlyErrors(const InstructionCounts& now) {
  constexpr std::pair<const char*, double> kLimits[] = {{", Gaussian noise", 2.5}, {", all errors", 5}};
  // Robot-steps without errors when the limits were set. The present ones take fewer instructions, which does not make
  // errors dearer.
  const std::map<std::string, double> exact_then{{"sonar", 7'783}, {"laser", 27'913}};
  std::vector<std::string> faults;
  for (const auto& [name, count] : now.instructions) {
    for (const auto& [ending, limit] : kLimits) {
      const auto at = name.find(ending);
      if (at == std::string::npos) continue;
      const auto exact = exact_then.find(name.substr(0, at));
      if (exact == exact_then.end()) {
        faults.push_back(name + ": there is no load without errors to compare with");
      } else if (count > limit * exact->second) {
        faults.push_back(name + ": " + fixed(count / exact->second, 2) + " times the " + numberText(exact->second) +
                         " instructions of " + exact->first + " without errors; " + fixed(limit, 1) +
                         " times is allowed: make the error model cheaper");
      }
    }
  }
  return faults;
}

std::string toTable(const InstructionCounts& now, const InstructionCounts& kept) {
  Rows rows{{"load", "instructions", "a", "kept", "change"}};
  for (const auto& load : instructionLoads()) {
    const auto count = now.instructions.find(load.name);
    if (count == now.instructions.end()) continue;
    rows.push_back({load.name, numberText(count->second), load.unit});
    const auto before = kept.instructions.find(load.name);
    if (before == kept.instructions.end()) continue;
    rows.back().push_back(numberText(before->second));
    rows.back().push_back(percentText(count->second, before->second));
  }
  return table(rows) + "Counted with " + now.compiler + ", the clones for " + now.vectors + ".\n";
}

InstructionCounts readCounts(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  std::ifstream in(file);
  try {
    return nlohmann::json::parse(in).get<InstructionCounts>();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file.string() + ": holds no counts of instructions: " + error.what());
  }
}

void writeCounts(const std::filesystem::path& file, const InstructionCounts& counts) {
  nlohmann::json json = counts;
  for (auto& count : json["instructions"]) count = std::round(10 * count.get<double>()) / 10;
  std::ofstream out(file);
  out << json.dump(2) << std::endl;
  if (!out) throw std::runtime_error(file.string() + ": could not be written");
}

}  // namespace robosim
