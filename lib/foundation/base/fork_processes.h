#pragma once
#include <cstddef>
#include <optional>

namespace robosim {

/// Forks this process `processes` times; the children end when it ends. Forked processes have equal memory layouts,
/// unlike programs started separately, so they share branch predictor entries: where many processes share a processor,
/// that halves their CPU time. Must be called before any thread is started.
/// @return in each child, its number; in the parent nullopt, once all children have ended successfully.
/// @throws std::runtime_error in the parent when a child has failed.
std::optional<std::size_t> forkProcesses(std::size_t processes);

}  // namespace robosim
