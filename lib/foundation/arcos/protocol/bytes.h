#pragma once
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace robosim::arcos {

/// Appends numbers to a text of bytes, lowest byte first.
class ByteWriter {
 public:
  template <std::integral Number>
  ByteWriter& add(Number number) {
    auto bits = static_cast<std::make_unsigned_t<Number>>(number);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_.push_back(static_cast<char>(bits & 0xFFu));
      bits = static_cast<decltype(bits)>(bits >> (sizeof(Number) > 1 ? 8 : 0));
    }
    return *this;
  }
  /// Adds a text and its terminating NUL. A NUL within the text ends it.
  ByteWriter& addText(std::string_view text) {
    bytes_ += text.substr(0, text.find('\0'));
    bytes_.push_back('\0');
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes numbers from bytes, lowest byte first. Beyond the end, numbers are 0 and texts are empty.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <std::integral Number>
  Number take() {
    if (rest_.size() < sizeof(Number)) {
      ended_early_ = true;
      rest_ = {};
      return 0;
    }
    std::make_unsigned_t<Number> bits = 0;
    for (std::size_t i = sizeof(Number); i-- > 0;) {
      bits = static_cast<decltype(bits)>((sizeof(Number) > 1 ? bits << 8 : 0) | static_cast<std::uint8_t>(rest_[i]));
    }
    rest_.remove_prefix(sizeof(Number));
    return static_cast<Number>(bits);
  }
  /// Takes a text up to its NUL.
  std::string takeText() {
    const auto end = rest_.find('\0');
    if (end == std::string_view::npos) {
      ended_early_ = true;
      rest_ = {};
      return {};
    }
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return text;
  }
  std::string_view rest() const { return rest_; }
  /// Whether something was taken beyond the end.
  bool endedEarly() const { return ended_early_; }

 private:
  std::string_view rest_;
  bool ended_early_ = false;
};

}  // namespace robosim::arcos
