#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace robosim {

/// Queue of robots whose head is the primary, driven by a person, while the others run autonomously. On a switch the
/// old primary goes to the tail, and the next fit robot becomes the head; skipped robots keep their positions (2005:
/// without skipping, the next robot).
class PrimaryQueue {
 public:
  /// @param robots number of robots, identified by index in the robot list
  /// @param primary the first head; the others follow in the list's order
  PrimaryQueue(std::size_t robots, std::size_t primary);

  std::size_t primary() const { return order_.front(); }
  /// The primary first.
  const std::vector<std::size_t>& order() const { return order_; }

  /// The next fit robot; nullopt when none besides the primary is fit.
  std::optional<std::size_t> next(const std::function<bool(std::size_t)>& is_fit) const;
  /// Moves the old primary to the tail and `robot` to the head. No effect if it is the primary.
  void switchTo(std::size_t robot);

 private:
  std::vector<std::size_t> order_;
};

}  // namespace robosim
