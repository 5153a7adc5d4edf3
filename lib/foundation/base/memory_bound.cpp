#include "base/memory_bound.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <new>
#include <set>

#include <fcntl.h>
#include <mrpt/core/aligned_allocator.h>
#include <unistd.h>

/// Replaces MRPT's function, which returns null without memory, upon which the elements of its aligned vectors (the
/// ranges of a scan) would be written to null.
///
/// A program's own function takes precedence over that of a shared library (a static MRPT would cause a linker error),
/// and MRPT frees the memory with std::free(). Defined in this file so that every program with a MemoryBound has it.
void* mrpt::aligned_malloc(std::size_t size, std::size_t alignment) {
  const std::size_t rounded_size = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* const memory = rounded_size >= size ? std::aligned_alloc(alignment, rounded_size) : nullptr;
  if (!memory) throw std::bad_alloc();
  return memory;
}

namespace robosim {
namespace {

/// The Holds of all threads: the largest bound applies, and the last one to end lifts it.
struct Holds {
  std::mutex mutex;
  std::multiset<rlim_t> bounds;
  rlimit outside{};  ///< the limit without them
  bool is_set = false;

  void apply() {
    if (bounds.empty()) {
      if (is_set) setrlimit(RLIMIT_DATA, &outside);
      is_set = false;
      return;
    }
    if (!is_set && getrlimit(RLIMIT_DATA, &outside) != 0) return;
    // RLIM_INFINITY is the largest number.
    const rlimit bounded{std::min(outside.rlim_cur, *bounds.rbegin()), outside.rlim_max};
    is_set = setrlimit(RLIMIT_DATA, &bounded) == 0 || is_set;
  }
};

Holds& holds() {
  static Holds all;
  return all;
}

}  // namespace

MemoryBound::MemoryBound(std::size_t headroom_bytes) : headroom_bytes_(headroom_bytes) {
  if (kBounds) statm_ = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
}

MemoryBound::~MemoryBound() {
  if (statm_ >= 0) close(statm_);
}

void MemoryBound::measure() {
  max_bytes_ = 0;
  if (statm_ < 0) return;
  char text[256] = {};
  // Pages: all, resident, shared, code, 0, data with the stacks, 0.
  unsigned long long data_pages = 0;
  if (pread(statm_, text, sizeof text - 1, 0) <= 0) return;
  if (std::sscanf(text, "%*u %*u %*u %*u %*u %llu", &data_pages) != 1) return;
  max_bytes_ = static_cast<rlim_t>(data_pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + headroom_bytes_;
}

MemoryBound::Hold::Hold(const MemoryBound& bound) : max_bytes_(bound.max_bytes_) {
  if (max_bytes_ == 0) return;
  const std::lock_guard lock(holds().mutex);
  holds().bounds.insert(max_bytes_);
  holds().apply();
}

MemoryBound::Hold::~Hold() {
  if (max_bytes_ == 0) return;
  const std::lock_guard lock(holds().mutex);
  holds().bounds.erase(holds().bounds.find(max_bytes_));
  holds().apply();
}

}  // namespace robosim
