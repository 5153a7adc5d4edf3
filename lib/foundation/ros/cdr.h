#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace robosim::ros {

/// CDR of ROS 2 messages (XCDR1): a header of four bytes, which names the byte order, then the fields in order. Each
/// primitive is aligned to its size, counted from the byte after the header, with zeros as padding. A string is its
/// length with the terminating NUL (32 bits), its bytes and the NUL; a sequence is its length (32 bits) and its
/// elements; an array only its elements. Source: OMG DDSI-RTPS 2.3, 10.2; ros2/rmw_cyclonedds, Serialization.cpp.

/// Bytes that are no encoded message of the expected type.
class CdrError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether T is encoded as its bytes: a number. A bool is a byte of 0 or 1, which the reader checks.
template <typename T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// A message: a struct with kType and a static template describe(self, visit), which calls visit(name, field) for each
/// field in order (messages.h).
template <typename T>
concept Message = requires {
  T::kType;
};

/// Appends an encoded message, little-endian.
class CdrWriter {
 public:
  /// Appends the header. @param bytes must outlive the writer
  explicit CdrWriter(std::vector<std::uint8_t>& bytes);

  template <Message M>
  void write(const M& message) {
    M::describe(message, [&](const char*, const auto& field) { write(field); });
  }
  void write(bool value) { bytes_.push_back(value ? 1 : 0); }
  template <typename T>
  requires kIsNumber<T>
  void write(T value) { std::memcpy(room(sizeof value, sizeof value), &value, sizeof value); }
  void write(const std::string& text);
  template <typename T>
  void write(const std::vector<T>& sequence) {
    write(static_cast<std::uint32_t>(sequence.size()));
    if (!sequence.empty()) writeElements(std::span(sequence));
  }
  template <typename T, std::size_t size>
  void write(const std::array<T, size>& array) {
    writeElements(std::span(array));
  }

 private:
  template <typename T, std::size_t extent>
  void writeElements(std::span<T, extent> elements) {
    if constexpr (kIsNumber<std::remove_const_t<T>>) {
      std::memcpy(room(sizeof(T), elements.size_bytes()), elements.data(), elements.size_bytes());
    } else {
      for (const auto& element : elements) write(element);
    }
  }
  /// Appends room for bytes after zeros up to an aligned place.
  std::uint8_t* room(std::size_t alignment, std::size_t size) {
    const std::size_t end = bytes_.size();
    const std::size_t padding = (origin_ - end) & (alignment - 1);  // modulo a power of two
    bytes_.resize(end + padding + size);
    return bytes_.data() + end + padding;
  }

  std::vector<std::uint8_t>& bytes_;
  std::size_t origin_;  ///< position of the byte after the header
};

/// Reads an encoded message, of either byte order. Bytes after the last field are ignored, as by other readers.
class CdrReader {
 public:
  /// @throws CdrError for bytes that do not begin with a header of XCDR1
  explicit CdrReader(std::span<const std::uint8_t> bytes);

  /// @throws CdrError when the bytes end before the message does, or cannot be of it.
  template <Message M>
  void read(M& message) {
    M::describe(message, [&](const char*, auto& field) { read(field); });
  }
  void read(bool& value);
  template <typename T>
  requires kIsNumber<T>
  void read(T& value) {
    align(sizeof value);
    copy(&value, sizeof value, sizeof value);
  }
  void read(std::string& text);
  template <typename T>
  void read(std::vector<T>& sequence) {
    std::uint32_t size = 0;
    read(size);
    // Each element takes at least a byte, so that the memory is bounded by that of the message.
    if (size > bytes_.size() - at_) fail("a sequence of " + std::to_string(size) + " elements");
    if constexpr (kIsNumber<T>) {
      sequence.clear();
      if (size == 0) return;
      align(sizeof(T));
      if (size > (bytes_.size() - at_) / sizeof(T)) fail("a sequence of " + std::to_string(size) + " elements");
      sequence.resize(size);
      copy(sequence.data(), size * sizeof(T), sizeof(T));
    } else {
      sequence.clear();
      for (std::uint32_t i = 0; i < size; ++i) read(sequence.emplace_back());
    }
  }
  template <typename T, std::size_t size>
  void read(std::array<T, size>& array) {
    if constexpr (kIsNumber<T>) {
      align(sizeof(T));
      copy(array.data(), size * sizeof(T), sizeof(T));
    } else {
      for (auto& element : array) read(element);
    }
  }

 private:
  void align(std::size_t size);
  /// @param unit size of the numbers of which the bytes consist
  void copy(void* to, std::size_t size, std::size_t unit);
  [[noreturn]] void fail(const std::string& what) const;

  std::span<const std::uint8_t> bytes_;  ///< after the header
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

/// Appends an encoded message.
template <Message M>
void encode(const M& message, std::vector<std::uint8_t>& bytes) {
  CdrWriter(bytes).write(message);
}

/// @throws CdrError as CdrReader does
template <Message M>
M decode(std::span<const std::uint8_t> bytes) {
  M message;
  CdrReader(bytes).read(message);
  return message;
}

}  // namespace robosim::ros
