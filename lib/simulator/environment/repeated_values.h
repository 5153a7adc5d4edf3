#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace robosim {

/// An array that does not change and of whose values many are equal, such as the limits of robots: it keeps an index
/// for each and the values once, most of which then stay in the processor's cache. If all are equal, there are no
/// indices.
template <typename Value>
class RepeatedValues {
 public:
  RepeatedValues() = default;
  explicit RepeatedValues(const std::vector<Value>& all) : size_(all.size()) {
    of_.reserve(all.size());
    for (const Value& value : all) of_.push_back(indexOf(value));
    values_.shrink_to_fit();
    if (values_.size() == 1) of_ = std::vector<std::uint32_t>();
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Value& operator[](std::size_t i) const { return of_.empty() ? values_.front() : values_[of_[i]]; }
  /// Each value of the array at least once.
  const std::vector<Value>& values() const { return values_; }

 private:
  /// Searches only the last values, so that an array without equal ones takes linear time, too.
  std::uint32_t indexOf(const Value& value) {
    constexpr std::ptrdiff_t kSearched = 16;
    const auto first = values_.end() - std::min<std::ptrdiff_t>(kSearched, std::ssize(values_));
    const auto found = std::find(first, values_.end(), value);
    const auto index = static_cast<std::uint32_t>(found - values_.begin());
    if (found == values_.end()) values_.push_back(value);
    return index;
  }

  std::size_t size_ = 0;
  std::vector<std::uint32_t> of_;
  std::vector<Value> values_;
};

}  // namespace robosim
