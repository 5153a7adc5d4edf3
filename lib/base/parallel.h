#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace robosim {

/// A fixed number of threads to share work among. Which thread does what is left to chance; so work that must give the
/// same numbers for any count writes only to slots of its own.
class Workers {
 public:
  /// @param threads 1 or more; more than the machine has cores is honoured (tests on small machines want it).
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Calls work(begin, end) for pieces of [0, n) of at most `chunk`, and returns when all are done.
  template <typename Work>
  void forChunks(std::size_t n, std::size_t chunk, const Work& work) const {
    const auto do_chunk = [&](std::size_t i) { work(i * chunk, std::min(n, (i + 1) * chunk)); };
    const std::size_t chunks = (n + chunk - 1) / chunk;
    if (threads_ == 1 || chunks <= 1) {
      for (std::size_t i = 0; i < chunks; ++i) do_chunk(i);
    } else {
      shareOut(chunks, std::cref(do_chunk));  // by reference: a function of its own could take memory, once a step
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
  class Threads;  // oneTBB's, whose headers are as much to compile as all else that includes this one

  void shareOut(std::size_t pieces, const std::function<void(std::size_t)>& work) const;

  int threads_;
  std::unique_ptr<Threads> shared_;
};

}  // namespace robosim
