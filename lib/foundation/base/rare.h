#pragma once
#include <memory>
#include <optional>
#include <utility>

namespace robosim {

/// An optional value that few of very many objects have: as std::optional, but one pointer large. Copies have values of
/// their own.
template <typename T>
class Rare {
 public:
  Rare() = default;
  Rare(std::nullopt_t) {}
  Rare(T value) : value_(std::make_unique<T>(std::move(value))) {}
  Rare(std::optional<T> value) : value_(value ? std::make_unique<T>(*std::move(value)) : nullptr) {}
  Rare(const Rare& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Rare(Rare&&) noexcept = default;
  Rare& operator=(const Rare& other) { return *this = Rare(other); }
  Rare& operator=(Rare&&) noexcept = default;
  ~Rare() = default;

  // NOLINTBEGIN(readability-identifier-naming): named as those of std::optional
  bool has_value() const { return value_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  /// @pre there is a value
  ///@{
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }
  ///@}
  T value_or(T other) const { return value_ ? *value_ : std::move(other); }
  // NOLINTEND(readability-identifier-naming)
  operator std::optional<T>() const { return value_ ? std::optional<T>(*value_) : std::nullopt; }

  T& emplace() { return *(value_ = std::make_unique<T>()); }
  void reset() { value_.reset(); }

  friend bool operator==(const Rare& a, const Rare& b) {
    return a.value_ && b.value_ ? *a.value_ == *b.value_ : a.value_ == b.value_;
  }
  friend bool operator==(const Rare& a, const T& b) { return a.value_ && *a.value_ == b; }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace robosim
