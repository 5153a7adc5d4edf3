#include "recording/memory_bound.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <fcntl.h>
#include <mrpt/core/aligned_allocator.h>
#include <unistd.h>

/// In place of MRPT's own, which gives null where there is no memory left. The elements of its aligned vectors (the
/// ranges of a scan) would then be written to null.
///
/// It does so because a program's own function goes before that of a shared library (linked with a static MRPT, there
/// would be two, which is an error of the linker), and because MRPT frees with std::free(). It stands in this file, so
/// that no program has a MemoryBound without it.
void* mrpt::aligned_malloc(std::size_t size, std::size_t alignment) {
  const std::size_t whole = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* const memory = whole >= size ? std::aligned_alloc(alignment, whole) : nullptr;
  if (!memory) throw std::bad_alloc();
  return memory;
}

namespace robosim {

MemoryBound::MemoryBound(std::size_t headroom_bytes) : headroom_bytes_(headroom_bytes) {
  if (kBounds) statm_ = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
}

MemoryBound::~MemoryBound() {
  if (statm_ >= 0) close(statm_);
}

void MemoryBound::measure() {
  most_bytes_ = 0;
  if (statm_ < 0) return;
  char text[256] = {};
  // Pages: all, resident, shared, code, 0, data with the stacks, 0.
  unsigned long long data_pages = 0;
  if (pread(statm_, text, sizeof text - 1, 0) <= 0) return;
  if (std::sscanf(text, "%*u %*u %*u %*u %*u %llu", &data_pages) != 1) return;
  most_bytes_ = static_cast<rlim_t>(data_pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + headroom_bytes_;
}

MemoryBound::Hold::Hold(const MemoryBound& bound) {
  if (bound.most_bytes_ == 0 || getrlimit(RLIMIT_DATA, &before_) != 0) return;
  // RLIM_INFINITY is the greatest number.
  const rlimit bounded{std::min(before_.rlim_cur, bound.most_bytes_), before_.rlim_max};
  is_set_ = setrlimit(RLIMIT_DATA, &bounded) == 0;
}

MemoryBound::Hold::~Hold() {
  if (is_set_) setrlimit(RLIMIT_DATA, &before_);
}

}  // namespace robosim
