#pragma once
#include <array>
#include <cstdint>

namespace robosim {

/// Purpose of a stream of random numbers; streams of different purposes are independent.
enum class RandomPurpose : std::uint32_t {
  sensor_noise,
  message_loss,
  controller,
  start_pose,
  scenery,
  test,
  sensor_retry,
  radio_burst,
  bootstrap,
  breakdown,
  walker
};

/// Counter-based random number generator (Philox 4×32-10; Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as
/// easy as 1, 2, 3", SC11; the library Random123). Its numbers depend only on the constructor's arguments, so that a
/// run does not depend on the number of threads or the order of robots. Satisfies std::uniform_random_bit_generator.
class Rng {
 public:
  using result_type = std::uint32_t;
  /// `robot` and `item` (such as a sensor's index, below 2^24) identify a stream of one purpose; `step` is the time
  /// step, of which the low 32 bits are used (13 years of tenths of a second).
  explicit Rng(std::uint64_t seed, RandomPurpose purpose = RandomPurpose::test, std::uint32_t robot = 0,
               std::uint32_t item = 0, std::uint64_t step = 0);

  /// Continues with the numbers of a block: the (4·block + 1)-th number and those after it.
  void skipToBlock(std::uint32_t block) {
    counter_[3] = block;
    left_ = 0;
  }

  result_type operator()() {
    if (left_ == 0) drawBlock();
    return block_[--left_];
  }
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffffu; }

  double uniform() {  ///< in [0, 1)
    const std::uint64_t high = (*this)() >> 5;
    const std::uint64_t low = (*this)() >> 6;
    return static_cast<double>((high << 26) | low) * 0x1p-53;
  }
  double uniform(double from, double to);  ///< in [from, to)
  double gaussian();                       ///< mean 0, standard deviation 1
  std::uint32_t below(std::uint32_t n);    ///< in [0, n), n > 0; even to within n / 2^32

 private:
  void drawBlock();

  std::uint64_t seed_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  unsigned left_ = 0;
};

}  // namespace robosim
