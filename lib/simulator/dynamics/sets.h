#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace robosim {

/// Sets of bodies that are connected with each other.
class Sets {
 public:
  explicit Sets(std::size_t bodies) : parent_(bodies) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t body) {
    while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
    return body;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace robosim
