#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.h"
#include "base/parallel_executor.h"

namespace robosim {

struct State;

/// Hash over all states and readings of a run. Robots are hashed in chunks of a fixed size, so that the digest does not
/// depend on the number of threads.
class RunDigest {
 public:
  RunDigest() = default;
  explicit RunDigest(std::size_t robots);
  /// Adds the result of a step; `state` may own this digest.
  void add(const State& state, const ParallelExecutor& workers);
  std::string text() const;
  std::size_t chunkCount() const { return of_chunk_.size(); }
  static std::size_t chunkCountOf(std::size_t robots);

  /// Appends chunkCount() times Digest::kSavedBytes bytes.
  void save(std::string& out) const;
  /// Continues from saved bytes of a digest of as many robots. @return false for bytes that save() cannot have written
  bool load(std::string_view saved);
  bool operator==(const RunDigest&) const = default;

 private:
  std::vector<Digest> of_chunk_;
};

}  // namespace robosim
