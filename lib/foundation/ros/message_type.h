#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "ros/cdr.h"

namespace robosim::ros {

/// Type of a field.
struct FieldType {
  enum class Repetition { one, array, sequence };

  std::string name;  ///< as in a .msg: "float64", "string"; of a message "geometry_msgs/msg/Pose"
  int id = 0;        ///< as in ROS's type descriptions; 1 for a message
  Repetition repetition = Repetition::one;
  std::size_t capacity = 0;  ///< of an array
};

/// Type of a message, derived from its struct (messages.h).
struct MessageType {
  struct Field {
    std::string name;
    FieldType type;
  };

  std::string name;  ///< "sensor_msgs/msg/LaserScan"
  std::vector<Field> fields;
  std::vector<const MessageType*> nested;  ///< types of its fields, each once, in the order of the fields

  /// The fields as a .msg file lists them, without constants, defaults and comments.
  std::string text() const;
  /// The definition as files and Foxglove carry it ("ros2msg"): text(), then, for each message in it at any depth, a
  /// line of 80 '=', a line "MSG: package/Name" and its text.
  std::string definition() const;
  /// "RIHS01_" and the SHA-256 of the type's description as JSON (REP 2016).
  std::string hash() const;
};

/// @name Types of fields
///@{
template <typename T>
FieldType numberType() {
  if constexpr (std::is_same_v<T, bool>) return {"bool", 15};
  if constexpr (std::is_same_v<T, float>) return {"float32", 10};
  if constexpr (std::is_same_v<T, double>) return {"float64", 11};
  constexpr bool is_unsigned = std::is_unsigned_v<T>;
  constexpr int bytes_log2 = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
  return {(is_unsigned ? "uint" : "int") + std::to_string(8 * sizeof(T)), 2 + 2 * bytes_log2 + (is_unsigned ? 1 : 0)};
}
template <Message M>
const MessageType& typeOf();

inline FieldType fieldType(const std::string&) { return {"string", 17}; }
template <typename T>
requires std::is_arithmetic_v<T> FieldType fieldType(const T&) { return numberType<T>(); }
template <Message M>
FieldType fieldType(const M&) {
  return {M::kType, 1};
}
template <typename T>
FieldType fieldType(const std::vector<T>&) {
  FieldType type = fieldType(T());
  type.repetition = FieldType::Repetition::sequence;
  return type;
}
template <typename T, std::size_t size>
FieldType fieldType(const std::array<T, size>&) {
  FieldType type = fieldType(T());
  type.repetition = FieldType::Repetition::array;
  type.capacity = size;
  return type;
}
/// The message in a field; null for none.
template <typename T>
const MessageType* messageIn(const T&) {
  if constexpr (Message<T>) return &typeOf<T>();
  return nullptr;
}
template <typename T>
const MessageType* messageIn(const std::vector<T>&) {
  return messageIn(T());
}
template <typename T, std::size_t size>
const MessageType* messageIn(const std::array<T, size>&) {
  return messageIn(T());
}
///@}

/// Appends to MessageType::nested, unless it is there.
void addNested(MessageType& type, const MessageType* nested);

/// The type of a message.
template <Message M>
const MessageType& typeOf() {
  static const MessageType type = [] {
    MessageType made{M::kType, {}, {}};
    const M message;
    M::describe(message, [&made](const char* name, const auto& field) {
      made.fields.push_back({name, fieldType(field)});
      addNested(made, messageIn(field));
    });
    return made;
  }();
  return type;
}

}  // namespace robosim::ros
