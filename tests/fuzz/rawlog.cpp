// A rawlog of anybody's, compressed or not: read to its end, given times, and taken for a recording of ours.
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "recording/observation_times.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "robots/world_source.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
std::atomic<std::size_t> taken_bytes = 0;

}  // namespace

// MRPT takes as much memory as a number in the file says, at once or in many pieces. MemoryBound makes that fail where
// there is no sanitizer; where there is one, this does. NOLINTNEXTLINE: the name is the sanitizer's
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1:max_allocation_size_mb=512"; }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* const memory = taken_bytes < kMostBytes ? std::malloc(size == 0 ? 1 : size) : nullptr;
  taken_bytes += malloc_usable_size(memory);
  return memory;
}
void* operator new(std::size_t size) {
  if (void* const memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  taken_bytes -= malloc_usable_size(memory);
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace {

/// A file in memory.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : file_(memfd_create("rawlog", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) throw std::runtime_error("no file");
  }
  ~Input() { close(file_); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

std::vector<RobotInfo> sampleRobots() {
  std::vector<RobotInfo> robots;
  for (auto& robot : loadWorld(readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"), {}).fleet.robots) {
    robots.push_back(robot.info);
  }
  return robots;
}

void readAll(const std::filesystem::path& file) {
  RawlogReader reader(file);
  ObservationTimes times;
  while (const auto observation = reader.next()) {
    times.of(*observation, reader.entries());
    partsOf(observation->sensorLabel);
  }
}

void readSteps(const std::filesystem::path& file) {
  static const std::vector<RobotInfo> robots = sampleRobots();
  RawlogReader reader(file);
  RecordedSteps steps(reader, robots, 0.1);
  while (steps.next()) {
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input(data, size);
  try {
    readAll(input.path());
    readSteps(input.path());
  } catch (const ConfigError&) {
  } catch (const RecordingError&) {
  }
  return 0;
}
