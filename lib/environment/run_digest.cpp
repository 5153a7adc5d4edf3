#include "environment/run_digest.h"

namespace robosim {
namespace {

constexpr std::size_t kChunk = 256;

void add(Digest& digest, const Measurement& measurement) {
  struct Adder {
    Digest& digest;
    void operator()(const Echoes& echoes) const {
      static_assert(sizeof(Echo) == 4 * sizeof(float), "padding would be hashed");
      digest.addBytes(echoes.data(), echoes.size() * sizeof(Echo));
    }
    void operator()(const Scalar& scalar) const { digest.add(scalar.value); }
    void operator()(const Contacts& contacts) const {
      digest.addBytes(contacts.pressed.data(), contacts.pressed.size());
    }
    void operator()(const Odometry& odometry) const {
      static_assert(sizeof(Odometry) == 5 * sizeof(double), "padding would be hashed");
      digest.addBytes(&odometry, sizeof odometry);
    }
  };
  std::visit(Adder{digest}, measurement);
}

void add(Digest& digest, const std::string& text) {
  digest.add(text.size());
  digest.addBytes(text.data(), text.size());
}

void addRobot(Digest& digest, const State& state, std::size_t i) {
  const auto& pose = state.world_from_robot[i];
  const double numbers[] = {pose.x,
                            pose.y,
                            pose.phi,
                            state.speed_mps[i],
                            state.turn_radps[i],
                            static_cast<double>(state.laser_pan_rad[i]),
                            static_cast<double>(state.activity[i]),
                            static_cast<double>(state.stalled[i])};
  digest.addBytes(numbers, sizeof numbers);
  for (const auto& measurement : state.readings[i].measurements) add(digest, measurement);
  for (const auto& message : state.readings[i].inbox) {
    add(digest, message.from);
    add(digest, message.text);
  }
}

}  // namespace

RunDigest::RunDigest(std::size_t robots) : of_chunk_((robots + kChunk - 1) / kChunk) {}

void RunDigest::add(const State& state, const Workers& workers) {
  workers.forChunks(state.world_from_robot.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Digest& digest = of_chunk_[begin / kChunk];
    digest.add(state.time.step);
    for (std::size_t i = begin; i < end; ++i) addRobot(digest, state, i);
  });
}

std::string RunDigest::text() const {
  Digest all;
  for (const auto& chunk : of_chunk_) all.add(chunk.value());
  return all.text();
}

}  // namespace robosim
