#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace robosim {

/// A fixed number of threads to share work among. Which thread does what is left to chance; so work that must give the
/// same numbers for any count writes only to slots of its own.
class Workers {
 public:
  /// @param threads 1 or more; more than the machine has cores is honoured (tests on small machines want it).
  explicit Workers(int threads)
      : threads_(std::max(1, threads)),
        allowance_(oneapi::tbb::global_control::max_allowed_parallelism,
                   std::max<std::size_t>(static_cast<std::size_t>(threads_),
                                         static_cast<std::size_t>(oneapi::tbb::info::default_concurrency()))),
        arena_(std::make_unique<oneapi::tbb::task_arena>(threads_)) {}

  int threads() const { return threads_; }

  /// Calls work(begin, end) for pieces of [0, n) of at most `chunk`, and returns when all are done.
  template <typename Work>
  void forChunks(std::size_t n, std::size_t chunk, const Work& work) const {
    if (n == 0) return;
    if (threads_ == 1 || n <= chunk) {
      for (std::size_t begin = 0; begin < n; begin += chunk) work(begin, std::min(n, begin + chunk));
      return;
    }
    arena_->execute([&] {
      const std::size_t chunks = (n + chunk - 1) / chunk;
      oneapi::tbb::parallel_for(std::size_t{0}, chunks,
                                [&](std::size_t i) { work(i * chunk, std::min(n, (i + 1) * chunk)); });
    });
  }

  /// Calls work(i) for every i of [0, n).
  template <typename Work>
  void forEach(std::size_t n, std::size_t chunk, const Work& work) const {
    forChunks(n, chunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  }

 private:
  int threads_;
  oneapi::tbb::global_control allowance_;
  std::unique_ptr<oneapi::tbb::task_arena> arena_;
};

}  // namespace robosim
