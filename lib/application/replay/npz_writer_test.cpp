#include "replay/npz_writer.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <new>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/temporary_directory.h"

namespace {

constexpr std::size_t kLargeAllocation = 1 << 20;
std::atomic<int> large_allocations{0};

}  // namespace

// Not inline: g++ 12 would warn about free() of memory from operator new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size >= kLargeAllocation) ++large_allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace robosim {
namespace {

TEST(NpzWriter, WritesArraysThatNumPyLoads) {
  const TemporaryDirectory folder;
  AtomicFile file(folder / "a.npz");
  NpzWriter npz(file);
  npz.addTable("Röver/sonar", 2, 3, [](std::size_t row, std::size_t column) { return 10.0 * row + column; });
  npz.addTable("none", 0, 2, [](std::size_t, std::size_t) { return 0.0; });
  npz.add("numbers", std::vector<double>{0.1, std::numeric_limits<double>::quiet_NaN()});
  npz.add("steps", std::vector<std::uint64_t>{1, std::uint64_t{1} << 60});
  npz.add("texts", std::vector<std::string>{"", "a", "15 °C → 😀"});
  npz.add("empty", std::vector<std::string>{""});
  npz.writeDirectory();
  file.commit();
  std::ofstream(folder / "check.py") << R"(import sys, numpy as np
a = np.load(sys.argv[1], allow_pickle=False)
assert a.files == ["Röver/sonar", "none", "numbers", "steps", "texts", "empty"], a.files
assert a["Röver/sonar"].tolist() == [[0, 1, 2], [10, 11, 12]]
assert a["none"].shape == (0, 2)
assert a["numbers"][0] == 0.1 and np.isnan(a["numbers"][1])
assert a["steps"].tolist() == [1, 2**60]
assert a["texts"].tolist() == ["", "a", "15 °C → 😀"]
assert a["empty"].tolist() == [""]
)";
  const std::string command =
      "/usr/bin/python3 '" + (folder / "check.py").string() + "' '" + (folder / "a.npz").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(NpzWriter, AllocatesTheMemoryOfAnArrayOnce) {
  const TemporaryDirectory folder;
  AtomicFile file(folder / "a.npz");
  NpzWriter npz(file);
  const std::vector<double> values(4 * kLargeAllocation / sizeof(double));
  const int before = large_allocations;
  npz.add("values", values);
  EXPECT_EQ(large_allocations - before, 2) << "the array of 4 MiB, and the space for the compressed one";
}

TEST(NpzWriter, RefusesWhatZipCannotHold) {
  const TemporaryDirectory folder;
  AtomicFile file(folder / "a.npz");
  NpzWriter npz(file);
  const auto zero = [](std::size_t, std::size_t) { return 0.0; };
  try {
    npz.addTable("large", std::size_t{1} << 28, 2, zero);
    FAIL() << "4 GiB";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("the array large exceeds a limit of .npz files"), std::string::npos)
        << error.what();
  }
  npz.addTable("same", 1, 1, zero);
  EXPECT_THROW(npz.addTable("same", 1, 1, zero), ConfigError);
  EXPECT_THROW(npz.addTable(std::string(70'000, 'x'), 1, 1, zero), ConfigError);
}

}  // namespace
}  // namespace robosim
