#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "ros/cdr.h"

namespace robosim::ros {

/// An encoded message in which only numbers change from step to step: all else is encoded once.
class MessageTemplate {
 public:
  MessageTemplate() = default;
  /// @param changing fields of the message, each a number or a sequence or array of numbers, which set() and at() know
  ///        by their order; a sequence keeps its size
  template <Message M, typename... Fields>
  explicit MessageTemplate(const M& message, const Fields&... changing) {
    encode(message, bytes_);
    (add(message, changing), ...);
  }
  /// Adds a changing field. @param message the one of the constructor
  template <Message M, typename Field>
  void add(const M& message, const Field& field) {
    positions_.push_back(positionOf(message, field));
  }

  bool empty() const { return bytes_.empty(); }
  std::span<const std::uint8_t> bytes() const { return bytes_; }

  /// Replaces a number. @param field as of the constructor @param value of exactly its type
  /// @param index of a number in a sequence or array
  template <typename T>
  requires kIsNumber<T>
  void set(std::size_t field, T value, std::size_t index = 0) {
    std::memcpy(bytes_.data() + positions_[field] + index * sizeof value, &value, sizeof value);
  }
  /// Replaces all numbers of a sequence or array, or the first ones.
  template <typename T>
  void set(std::size_t field, std::span<const T> values) {
    if (!values.empty()) std::memcpy(bytes_.data() + positions_[field], values.data(), values.size_bytes());
  }

 private:
  /// Position of the field's bytes in the encoded message.
  template <Message M, typename Field>
  static std::size_t positionOf(const M& message, const Field& field) {
    std::vector<std::uint8_t> bytes;
    CdrWriter writer(bytes);
    std::size_t position = 0;
    const auto visit = [&](const auto& self, const auto& part) -> void {
      using Part = std::remove_cvref_t<decltype(part)>;
      if constexpr (Message<Part>) {
        Part::describe(part, [&](const char*, const auto& inner) { self(self, inner); });
      } else if constexpr (requires { requires Message<typename Part::value_type>; }) {
        if constexpr (requires { part.capacity(); }) writer.write(static_cast<std::uint32_t>(part.size()));
        for (const auto& element : part) self(self, element);
      } else {
        writer.write(part);
        if constexpr (std::is_same_v<Part, Field>) {
          if (&part == &field) position = bytes.size() - sizeOf(part);
        }
      }
    };
    visit(visit, message);
    return position;
  }
  template <typename T>
  static std::size_t sizeOf(const T& numbers) {
    if constexpr (kIsNumber<T>) {
      return sizeof numbers;
    } else {
      return std::span(numbers).size_bytes();
    }
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<std::size_t> positions_;  ///< by field
};

}  // namespace robosim::ros
