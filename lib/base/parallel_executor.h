#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace robosim {

/// Executes work in parallel on a fixed number of threads. The assignment of work to threads is not deterministic; for
/// results that do not depend on the number of threads, each piece of work must write only to its own outputs.
class ParallelExecutor {
 public:
  /// @param threads at least 1; may exceed the number of cores (used by tests on small machines).
  explicit ParallelExecutor(int threads);
  ~ParallelExecutor();
  ParallelExecutor(const ParallelExecutor&) = delete;
  ParallelExecutor& operator=(const ParallelExecutor&) = delete;

  int threads() const { return threads_; }

  /// Calls work(begin, end) for pieces of [0, n) of at most `chunk` elements, and returns when all are done.
  template <typename Work>
  void forChunks(std::size_t n, std::size_t chunk, const Work& work) const {
    const auto do_chunk = [&](std::size_t i) { work(i * chunk, std::min(n, (i + 1) * chunk)); };
    const std::size_t chunks = (n + chunk - 1) / chunk;
    if (threads_ == 1 || chunks <= 1) {
      for (std::size_t i = 0; i < chunks; ++i) do_chunk(i);
    } else {
      distribute(chunks, std::cref(do_chunk));  // by reference: a copied closure could allocate memory in each step
    }
  }

  /// Calls work(i) for every i of [0, n).
  template <typename Work>
  void forEach(std::size_t n, std::size_t chunk, const Work& work) const {
    forChunks(n, chunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  }

 private:
  class Threads;  // hides oneTBB's headers, which are slow to compile

  void distribute(std::size_t pieces, const std::function<void(std::size_t)>& work) const;

  int threads_;
  std::unique_ptr<Threads> pool_;
};

}  // namespace robosim
