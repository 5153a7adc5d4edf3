#include "benchmark/search_runs.h"

#include <mutex>

#include "base/parallel_executor.h"

namespace robosim {

void makeRuns(const NumberedRuns& source, int threads, const std::function<bool()>& is_interrupted,
              const std::function<void(const SearchRun&)>& finished, SearchRuns& runs) {
  const auto to_do = missing(runs);
  std::mutex mutex;
  ParallelExecutor(threads).forEach(to_do.size(), 1, [&](std::size_t i) {
    if (is_interrupted()) return;
    auto run = source.run(to_do[i], is_interrupted);
    if (!run) return;
    const std::lock_guard lock(mutex);
    finished(*run);
    runs[to_do[i]] = std::move(run);
  });
}

std::vector<std::size_t> missing(const SearchRuns& runs) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i]) indices.push_back(i);
  }
  return indices;
}

}  // namespace robosim
