#pragma once
#include <array>
#include <cstdint>

namespace robosim {

/// What a stream of random numbers is for; streams of different purposes are independent.
enum class RandomPurpose : std::uint32_t { sensor_noise, message_loss, controller, start_pose, scenery, test };

/// Random numbers that depend on nothing but who asks, when and for what: a counter-based generator (Philox 4×32-10;
/// Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11; the library Random123).
/// So the same run comes out for any number of threads and any order of robots. Satisfies
/// std::uniform_random_bit_generator.
class Rng {
 public:
  using result_type = std::uint32_t;
  /// `robot` and `item` (a sensor's index, say) tell apart streams of one purpose; `step` is the time step, of which
  /// the low 32 bits count (13 years of tenths of a second), and `item` is below 2^24.
  explicit Rng(std::uint64_t seed, RandomPurpose purpose = RandomPurpose::test, std::uint32_t robot = 0,
               std::uint32_t item = 0, std::uint64_t step = 0);

  result_type operator()();
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffffu; }

  double uniform();                        ///< in [0, 1)
  double uniform(double from, double to);  ///< in [from, to)
  double gaussian();                       ///< mean 0, standard deviation 1
  std::uint32_t below(std::uint32_t n);    ///< in [0, n), n > 0; even to within n / 2^32

 private:
  std::uint64_t seed_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  unsigned left_ = 0;
};

}  // namespace robosim
