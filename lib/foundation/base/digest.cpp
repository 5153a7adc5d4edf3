#include "base/digest.h"

#include <cstdio>
#include <cstring>

#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>
#if defined(__x86_64__) && __has_include(<xxh_x86dispatch.h>)
#include <xxh_x86dispatch.h>  // the same hash by the widest vectors of the processor
#endif

namespace robosim {

struct Digest::State {
  XXH3_state_t xxh;
};

Digest::Digest() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->xxh); }
Digest::~Digest() = default;
Digest::Digest(const Digest& other) : state_(std::make_unique<State>(*other.state_)) {}
Digest& Digest::operator=(const Digest& other) {
  *state_ = *other.state_;
  return *this;
}
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

void Digest::addBytes(const void* data, std::size_t size) { XXH3_64bits_update(&state_->xxh, data, size); }

std::uint64_t Digest::value() const { return XXH3_64bits_digest(&state_->xxh); }

// xxHash has no function that saves a state. The members below are all that differs between two states of one seed and
// secret; their meaning follows from the algorithm, which is fixed since version 0.8.0.
static_assert(XXH_VERSION_NUMBER >= 800 && XXH_VERSION_NUMBER < 900, "compare the members of XXH3_state_t");

void Digest::save(std::string& out) const {
  const XXH3_state_t& xxh = state_->xxh;
  const auto append = [&](const void* data, std::size_t size) { out.append(static_cast<const char*>(data), size); };
  const std::uint64_t total_bytes = xxh.totalLen;
  const std::uint32_t buffered_bytes = xxh.bufferedSize;
  const auto stripes = static_cast<std::uint32_t>(xxh.nbStripesSoFar);
  append(xxh.acc, sizeof xxh.acc);
  append(xxh.buffer, sizeof xxh.buffer);
  append(&total_bytes, sizeof total_bytes);
  append(&buffered_bytes, sizeof buffered_bytes);
  append(&stripes, sizeof stripes);
  static_assert(sizeof xxh.acc + sizeof xxh.buffer + sizeof total_bytes + sizeof buffered_bytes + sizeof stripes ==
                kSavedBytes);
}

bool Digest::load(std::string_view saved) {
  if (saved.size() != kSavedBytes) return false;
  XXH3_state_t loaded = Digest().state_->xxh;
  std::uint64_t total_bytes = 0;
  std::uint32_t buffered_bytes = 0, stripes = 0;
  const auto take = [&](void* data, std::size_t size) {
    std::memcpy(data, saved.data(), size);
    saved.remove_prefix(size);
  };
  take(loaded.acc, sizeof loaded.acc);
  take(loaded.buffer, sizeof loaded.buffer);
  take(&total_bytes, sizeof total_bytes);
  take(&buffered_bytes, sizeof buffered_bytes);
  take(&stripes, sizeof stripes);
  // xxHash indexes its buffer and secret by these without a check. Only an empty digest has an empty buffer.
  if (buffered_bytes > sizeof loaded.buffer || stripes >= loaded.nbStripesPerBlock) return false;
  if (total_bytes <= sizeof loaded.buffer ? buffered_bytes != total_bytes : buffered_bytes == 0) return false;
  loaded.totalLen = total_bytes;
  loaded.bufferedSize = buffered_bytes;
  loaded.nbStripesSoFar = stripes;
  state_->xxh = loaded;
  return true;
}

std::string Digest::text() const {
  char buffer[17];
  std::snprintf(buffer, sizeof buffer, "%016llx", static_cast<unsigned long long>(value()));
  return buffer;
}

}  // namespace robosim
