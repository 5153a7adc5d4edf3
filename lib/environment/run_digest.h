#pragma once
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/parallel.h"
#include "environment/state.h"

namespace robosim {

/// Hash over all states and readings of a run, step by step. Robots are hashed in chunks of a fixed size, so that the
/// digest is the same for any number of threads.
class RunDigest {
 public:
  explicit RunDigest(std::size_t robots);
  void add(const State& state, const Workers& workers);
  std::string text() const;

 private:
  std::vector<Digest> of_chunk_;
};

}  // namespace robosim
