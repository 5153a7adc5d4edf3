#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

namespace robosim {

/// A running hash (XXH3, 64 bits) over everything added to it, in order. Equal digests identify equal runs.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&);
  Digest& operator=(const Digest&);
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  void addBytes(const void* data, std::size_t size);
  /// @param value of a type without padding bytes, whose content is undefined.
  template <typename T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    addBytes(&value, sizeof value);
  }
  std::uint64_t value() const;
  /// 16 hexadecimal digits.
  std::string text() const;
  /// @name Continuing a digest in another process
  ///@{
  static constexpr std::size_t kSavedBytes = 336;
  /// Appends kSavedBytes bytes, from which load() continues.
  void save(std::string& out) const;
  /// @param saved kSavedBytes bytes
  /// @return false, and no change, for bytes that save() cannot have written
  bool load(std::string_view saved);
  ///@}
  /// Whether the values are equal, as they are after the same bytes.
  bool operator==(const Digest& other) const { return value() == other.value(); }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace robosim
