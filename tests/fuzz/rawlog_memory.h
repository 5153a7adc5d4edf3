#pragma once
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

// Shared by the targets that read rawlogs, each of which is one source file: a memory limit, and files in memory.

namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
std::atomic<std::size_t> taken_bytes = 0;

void* allocate(std::size_t size) {
  void* const memory = taken_bytes < kMaxBytes ? std::malloc(size == 0 ? 1 : size) : nullptr;
  taken_bytes += malloc_usable_size(memory);
  return memory;
}
void release(void* memory) {
  taken_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

// MRPT allocates as much memory as a number in the file specifies, at once or in pieces. MemoryBound makes such
// allocations fail in builds without a sanitizer; this option does so in builds with one. NOLINTNEXTLINE: name required
// by the sanitizer
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1:max_allocation_size_mb=512"; }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void* operator new(std::size_t size) {
  if (void* const memory = allocate(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }

namespace robosim {

/// A file in memory.
class FileInMemory {
 public:
  FileInMemory(const std::uint8_t* data, std::size_t size) : file_(memfd_create("rawlog", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) throw std::runtime_error("no file");
  }
  ~FileInMemory() { close(file_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace robosim
