#include "base/digest.h"

#include <cstdio>

#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

namespace robosim {

struct Digest::State {
  XXH3_state_t xxh;
};

Digest::Digest() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->xxh); }
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

void Digest::addBytes(const void* data, std::size_t size) { XXH3_64bits_update(&state_->xxh, data, size); }

std::uint64_t Digest::value() const { return XXH3_64bits_digest(&state_->xxh); }

std::string Digest::text() const {
  char buffer[17];
  std::snprintf(buffer, sizeof buffer, "%016llx", static_cast<unsigned long long>(value()));
  return buffer;
}

}  // namespace robosim
