#pragma once
#include <algorithm>
#include <array>
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
    if (n <= chunk) {  // in a small world the rest would cost more than the work
      if (n > 0) work(0, n);
      return;
    }
    const auto do_chunk = [&](std::size_t i) { work(i * chunk, std::min(n, (i + 1) * chunk)); };
    const std::size_t chunks = (n + chunk - 1) / chunk;
    if (threads_ == 1) {
      for (std::size_t i = 0; i < chunks; ++i) do_chunk(i);
    } else {
      distribute(chunks, std::cref(do_chunk));  // by reference: a copied closure could allocate memory in each step
    }
  }

  /// At most so many pieces does reduce() divide its elements into.
  static constexpr std::size_t kPiecesMax = 64;
  /// Number of pieces of about equal size into which reduce() divides n elements: at least 4,096 elements each.
  static constexpr std::size_t piecesOf(std::size_t n) { return std::clamp<std::size_t>(n / 4096, 1, kPiecesMax); }

  /// combine(combine(start, map(begin, end)), …) over pieces of [0, n), in their order: the same value for any number
  /// of threads, also of sums of floating-point numbers.
  template <typename Value, typename Map, typename Combine>
  Value reduce(std::size_t n, Value start, const Map& map, const Combine& combine) const {
    const std::size_t pieces = piecesOf(n);
    if (pieces == 1) return combine(start, map(0, n));  // without the array, which costs more than a small world's work
    std::array<Value, kPiecesMax> of_piece{};
    forChunks(pieces, 1, [&](std::size_t p, std::size_t) { of_piece[p] = map(p * n / pieces, (p + 1) * n / pieces); });
    for (std::size_t p = 0; p < pieces; ++p) start = combine(start, of_piece[p]);
    return start;
  }

  /// Whether is_true(i) for any i of [0, n).
  template <typename IsTrue>
  bool anyOf(std::size_t n, const IsTrue& is_true) const {
    const auto any = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (is_true(i)) return true;
      }
      return false;
    };
    return reduce(n, false, any, [](bool a, bool b) { return a || b; });
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
  std::unique_ptr<Threads> pool_;  ///< null for one thread
};

}  // namespace robosim
