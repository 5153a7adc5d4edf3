#pragma once
#include <concepts>
#include <type_traits>
#include <utility>

#include "base/rare.h"

namespace robosim {

/// A value that equals T() in most of very many objects, such as an inbox without messages: one pointer large, null
/// until the value is set. Copies have values of their own. It reads as a T; edit() gives a T that can be changed.
template <typename T>
class OftenDefault {
 public:
  OftenDefault() = default;
  template <typename Value>
  requires(std::convertible_to<Value, T> && !std::same_as<std::remove_cvref_t<Value>, OftenDefault>)
      OftenDefault(Value&& value) {  // NOLINT(bugprone-forwarding-reference-overload): not of this type
    if (T own = std::forward<Value>(value); !(own == kDefault)) value_ = std::move(own);
  }

  const T& get() const { return value_ ? *value_ : kDefault; }
  operator const T&() const { return get(); }
  const T& operator*() const { return get(); }
  const T* operator->() const { return &get(); }
  T& edit() { return value_ ? *value_ : value_.emplace(); }

  /// @name Of a container
  ///@{
  bool empty() const { return get().empty(); }
  auto size() const { return get().size(); }
  auto begin() const { return get().begin(); }
  auto end() const { return get().end(); }
  const auto& operator[](std::size_t i) const { return get()[i]; }
  const auto& back() const { return get().back(); }
  /// Keeps the memory.
  void clear() {
    if (value_) value_->clear();
  }
  ///@}

  friend bool operator==(const OftenDefault& a, const OftenDefault& b) { return a.get() == b.get(); }
  template <typename Value>
  friend bool operator==(const OftenDefault& a, const Value& b) {
    return a.get() == b;
  }

 private:
  static inline const T kDefault{};
  Rare<T> value_;
};

}  // namespace robosim
