#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

namespace robosim {

/// A running hash (XXH3, 64 bits) over everything added to it, in order: two runs with the same digest were the same
/// run.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  void addBytes(const void* data, std::size_t size);
  /// @param value has no padding bytes: their content is not defined.
  template <typename T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    addBytes(&value, sizeof value);
  }
  std::uint64_t value() const;
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace robosim
