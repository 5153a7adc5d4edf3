#pragma once
#include <memory>
#include <utility>

namespace robosim {

/// A value that many objects have alike and share, such as what robots of a type have in common. Copies share it until
/// one of them is changed by edit(). Null for T().
template <typename T>
class SharedValue {
 public:
  SharedValue() = default;
  SharedValue(T value) : value_(std::make_shared<T>(std::move(value))) {}

  const T& operator*() const { return value_ ? *value_ : kDefault; }
  const T* operator->() const { return &**this; }
  /// A value that is not shared. @pre no other thread copies this object meanwhile
  T& edit() {
    if (value_.use_count() != 1) value_ = std::make_shared<T>(**this);
    return *value_;
  }
  bool operator==(const SharedValue& other) const { return value_ == other.value_ || **this == *other; }

 private:
  static inline const T kDefault{};
  std::shared_ptr<T> value_;
};

}  // namespace robosim
