#include "environment/run_digest.h"

namespace robosim {
namespace {

constexpr std::size_t kChunk = 256;

/// Bytes of many robots in one run: a hash takes long ones in several times as fast as many short ones.
class Bytes {
 public:
  void clear() { bytes_.clear(); }
  void add(const void* data, std::size_t size) {
    const auto* begin = static_cast<const unsigned char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  void add(const std::string& text) {
    const std::uint64_t size = text.size();
    add(&size, sizeof size);
    add(text.data(), text.size());
  }
  void add(const Measurement& measurement) {
    std::visit([this](const auto& of_kind) { addKind(of_kind); }, measurement);
  }
  void addTo(Digest& digest) const { digest.addBytes(bytes_.data(), bytes_.size()); }

 private:
  void addKind(const Echoes& echoes) {
    static_assert(sizeof(Echo) == 4 * sizeof(float), "padding would be hashed");
    add(echoes.data(), echoes.size() * sizeof(Echo));
  }
  void addKind(const Scalar& scalar) { add(&scalar.value, sizeof scalar.value); }
  void addKind(const Contacts& contacts) { add(contacts.pressed.data(), contacts.pressed.size()); }
  void addKind(const Odometry& odometry) {
    static_assert(sizeof(Odometry) == 5 * sizeof(double), "padding would be hashed");
    add(&odometry, sizeof odometry);
  }
  // Another machine may draw another picture of the same run (doc/decisions/pictures.md).
  void addKind(const Image&) {}
  void addKind(const Blobs&) {}

  std::vector<unsigned char> bytes_;
};

void addRobot(Bytes& bytes, const State& state, std::size_t i) {
  const auto& pose = state.world_from_robot[i];
  const double numbers[] = {pose.x,
                            pose.y,
                            pose.phi,
                            state.speed_mps[i],
                            state.turn_radps[i],
                            static_cast<double>(state.laser_pan_rad[i]),
                            static_cast<double>(state.activity[i]),
                            static_cast<double>(state.stalled[i])};
  bytes.add(numbers, sizeof numbers);
  for (const auto& measurement : state.readings[i].measurements) bytes.add(measurement);
  for (const auto& message : state.readings[i].inbox) {
    bytes.add(message.from);
    bytes.add(message.text);
  }
  // Nothing is added for a run in which nobody asks.
  if (state.readings[i].is_too_far) bytes.add("too far");
  if (!state.readings[i].winner.empty()) bytes.add(state.readings[i].winner);
}

}  // namespace

RunDigest::RunDigest(std::size_t robots) : of_chunk_((robots + kChunk - 1) / kChunk) {}

void RunDigest::add(const State& state, const Workers& workers) {
  workers.forChunks(state.world_from_robot.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    static thread_local Bytes bytes;
    bytes.clear();
    bytes.add(&state.time.step, sizeof state.time.step);
    for (std::size_t i = begin; i < end; ++i) addRobot(bytes, state, i);
    bytes.addTo(of_chunk_[begin / kChunk]);
  });
}

std::string RunDigest::text() const {
  Digest all;
  for (const auto& chunk : of_chunk_) all.add(chunk.value());
  return all.text();
}

}  // namespace robosim
