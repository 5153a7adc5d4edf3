#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace robosim {

/// Whose turn it is to be driven. The robots stand in a row; the one at its head is the primary, which a person drives,
/// and the others run autonomously. On a switch the old primary goes to the tail, and the next that is fit becomes the
/// head; those that are passed over keep their places (2005: without any that are down, simply the next).
class Rota {
 public:
  /// @param robots how many; they are told by their places in the robot list
  /// @param primary the first head; the others follow in the list's order
  Rota(std::size_t robots, std::size_t primary);

  std::size_t primary() const { return row_.front(); }
  const std::vector<std::size_t>& row() const { return row_; }

  /// The next whose turn it is; nullopt when none besides the primary is fit.
  std::optional<std::size_t> next(const std::function<bool(std::size_t)>& is_fit) const;
  /// The old primary to the tail, `robot` to the head. Nothing changes if it is the primary.
  void switchTo(std::size_t robot);

 private:
  std::vector<std::size_t> row_;
};

}  // namespace robosim
