#include "distributed/ranks/launcher.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace robosim {
namespace {

std::optional<int> numberIn(const char* variable) {
  const char* const text = std::getenv(variable);
  if (!text) return std::nullopt;
  const std::string_view digits(text);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

LaunchedRank launchedRank() {
  constexpr const char* kVariables[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                           {"PMI_RANK", "PMI_SIZE"},
                                           {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [of_rank, of_size] : kVariables) {
    const auto rank = numberIn(of_rank), size = numberIn(of_size);
    if (rank && size && *rank < *size) return {*rank, *size};
  }
  return {};
}

}  // namespace robosim
