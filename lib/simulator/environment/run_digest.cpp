#include "environment/run_digest.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "environment/state.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

constexpr std::size_t kDigestChunk = RunDigest::kRobotsPerChunk;

/// Buffer of the bytes of many robots: hashing one long buffer is several times as fast as hashing many short ones.
class Bytes {
 public:
  void clear() { size_ = 0; }
  void add(const void* data, std::size_t size) { std::memcpy(extend(size), data, size); }
  /// Appends a value of a size that the compiler knows.
  template <typename T>
  void addValue(const T& value) {
    std::memcpy(extend(sizeof value), &value, sizeof value);
  }
  void add(const std::string& text) {
    const std::uint64_t size = text.size();
    add(&size, sizeof size);
    add(text.data(), text.size());
  }
  void add(const Measurement& measurement) {
    // The most frequent kinds first: std::visit() calls a function that is not inlined.
    if (const auto* echoes = std::get_if<Echoes>(&measurement)) return addNumbers(*echoes);
    if (const auto* odometry = std::get_if<Odometry>(&measurement)) return addNumbers(*odometry);
    std::visit([this](const auto& kind) { addNumbers(kind); }, measurement);
  }
  void addTo(Digest& digest) const { digest.addBytes(bytes_.data(), size_); }

 private:
  template <typename M>
  void addNumbers(const M& measurement) {
    if constexpr (kIsReproducible<M>) {
      static_assert(kIsDense<M>, "padding would be hashed");
      const auto records = Description<M>::records(measurement);
      // Without a lateral speed of 0, which most drives always have, digests are those of versions that had none.
      if constexpr (std::is_same_v<M, Odometry>) {
        constexpr std::size_t kWithoutLateral = sizeof(Odometry) - sizeof(Odometry::lateral_mps);
        if (measurement.lateral_mps == 0) {
          std::memcpy(extend(kWithoutLateral), records.data(), kWithoutLateral);
          return;
        }
      }
      add(records.data(), records.size_bytes());
    } else if constexpr (requires { Description<M>::exactBytes(measurement); }) {
      for (const auto& part : Description<M>::exactBytes(measurement)) {
        if (!part.empty()) add(part.data(), part.size());
      }
    }
  }

  /// @return the place of further bytes
  unsigned char* extend(std::size_t size) {
    if (bytes_.size() - size_ < size) bytes_.resize(2 * bytes_.size() + size);
    unsigned char* const at = bytes_.data() + size_;
    size_ += size;
    return at;
  }

  std::vector<unsigned char>
      bytes_;             ///< kept from robot to robot, because appending to a vector costs more than the copies
  std::size_t size_ = 0;  ///< bytes in use
};

void addRobot(Bytes& bytes, const State& state, std::size_t i) {
  if (state.isAbsent(i)) {  // the rest of its state has no effect, and no recording contains it
    bytes.add(&state.activity[i], sizeof state.activity[i]);
    return;
  }
  const auto& pose = state.world_from_robot[i];
  const double numbers[] = {pose.x,
                            pose.y,
                            pose.phi,
                            state.speed_mps[i],
                            state.turn_radps[i],
                            static_cast<double>(state.laser_pan_rad[i]),
                            static_cast<double>(state.activity[i]),
                            static_cast<double>(state.stalled[i])};
  bytes.addValue(numbers);
  if (!state.drives.empty()) bytes.add(&state.drives[i], sizeof state.drives[i]);
  for (const auto& measurement : state.readings[i].measurements) bytes.add(measurement);
  for (const auto& message : state.readings[i].inbox) {
    bytes.add(message.from);
    bytes.add(message.text);
  }
  // Nothing is added for a run without LEDs and checkWin().
  if (const auto color = state.commands[i].led_color; color != 0) bytes.add(&color, sizeof color);
  if (state.readings[i].is_too_far) bytes.add("too far");
  if (!state.readings[i].winner.empty()) bytes.add(*state.readings[i].winner);
}

}  // namespace

std::size_t RunDigest::chunkCountOf(std::size_t robots) { return (robots + kDigestChunk - 1) / kDigestChunk; }

RunDigest::RunDigest(std::size_t robots) : of_chunk_(chunkCountOf(robots)) {}

void RunDigest::add(const State& state, const ParallelExecutor& workers) {
  add(state, workers, {0, state.world_from_robot.size()});
}

void RunDigest::add(const State& state, const ParallelExecutor& workers, RobotRange robots) {
  workers.forChunks(robots.end - robots.begin, kDigestChunk, [&](std::size_t begin, std::size_t end) {
    static thread_local Bytes bytes;
    bytes.clear();
    bytes.add(&state.time.step, sizeof state.time.step);
    for (std::size_t i = robots.begin + begin; i < robots.begin + end; ++i) addRobot(bytes, state, i);
    bytes.addTo(of_chunk_[(robots.begin + begin) / kDigestChunk]);
  });
}

void RunDigest::add(std::span<const ObjectMotion> objects) {
  for (const ObjectMotion& object : objects) {
    const auto& pose = object.world_from_object;
    for (const double number : {pose.x, pose.y, pose.phi, object.vx_mps, object.vy_mps, object.turn_radps}) {
      of_objects_.add(number);
    }
    if (object.walk == Walk()) continue;
    for (const std::uint32_t number : {object.walk.leg, object.walk.is_returning ? 1u : 0u, object.walk.waited_steps}) {
      of_objects_.add(number);
    }
  }
}

void RunDigest::add(std::uint64_t step, const Change& change) {
  const std::string text = changeText(change);
  of_objects_.add(step);
  of_objects_.add(text.size());
  of_objects_.addBytes(text.data(), text.size());
}

void RunDigest::save(std::string& out) const {
  of_objects_.save(out);
  save({0, of_chunk_.size() * kDigestChunk}, out);
}

void RunDigest::save(RobotRange robots, std::string& out) const {
  for (std::size_t i = robots.begin / kDigestChunk; i < chunkCountOf(robots.end); ++i) of_chunk_[i].save(out);
}

bool RunDigest::load(std::string_view saved) {
  return saved.size() == savedBytes() && of_objects_.load(saved.substr(0, Digest::kSavedBytes)) &&
         load({0, of_chunk_.size() * kDigestChunk}, saved.substr(Digest::kSavedBytes));
}

bool RunDigest::load(RobotRange robots, std::string_view saved) {
  const std::size_t first = robots.begin / kDigestChunk;
  const std::size_t count = std::max(first, chunkCountOf(robots.end)) - first;
  if (saved.size() != count * Digest::kSavedBytes) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!of_chunk_[first + i].load(saved.substr(i * Digest::kSavedBytes, Digest::kSavedBytes))) return false;
  }
  return true;
}

std::string RunDigest::text() const {
  Digest all;
  for (const auto& chunk : of_chunk_) all.add(chunk.value());
  if (of_objects_ != Digest()) all.add(of_objects_.value());
  return all.text();
}

}  // namespace robosim
