#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.h"
#include "base/parallel_executor.h"
#include "dynamics/movable_body.h"
#include "environment/robot_range.h"
#include "world/intervention.h"

namespace robosim {

struct State;

/// Hash over all states and readings of a run. Robots are hashed in chunks of a fixed size, so that the digest does not
/// depend on the number of threads.
class RunDigest {
 public:
  RunDigest() = default;
  explicit RunDigest(std::size_t robots);
  /// Continues with another number of robots, of which the first remain the same.
  void setRobots(std::size_t robots) { of_chunk_.resize(chunkCountOf(robots)); }
  /// Adds the result of a step; `state` may own this digest.
  void add(const State& state, const ParallelExecutor& workers);
  /// The same for some robots, which are whole chunks.
  void add(const State& state, const ParallelExecutor& workers, RobotRange robots);
  /// Adds the movable objects after a step.
  void add(std::span<const ObjectMotion> objects);
  /// Adds an intervention before a step. Its author has no effect.
  void add(std::uint64_t step, const Change& change);
  std::string text() const;
  /// Number of robots in a chunk, but the last.
  static constexpr std::size_t kRobotsPerChunk = 256;
  std::size_t chunkCount() const { return of_chunk_.size(); }
  static std::size_t chunkCountOf(std::size_t robots);

  /// Number of bytes of save().
  std::size_t savedBytes() const { return (chunkCount() + 1) * Digest::kSavedBytes; }
  void save(std::string& out) const;
  /// The part of save() for the chunks of some robots. @param robots whole chunks
  void save(RobotRange robots, std::string& out) const;
  /// Continues from saved bytes of a digest of as many robots. @return false for bytes that save() cannot have written
  bool load(std::string_view saved);
  /// The same for a part. @param robots whole chunks
  bool load(RobotRange robots, std::string_view saved);
  bool operator==(const RunDigest&) const = default;

 private:
  std::vector<Digest> of_chunk_;
  Digest of_objects_;  ///< of interventions and of movable objects; without effect while empty
};

}  // namespace robosim
