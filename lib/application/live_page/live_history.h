#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "live_page/live_encoding.h"

namespace robosim {

/// The items of a run so far, for pages that are opened during it, within bounds. When there are too many moments,
/// every second one is dropped: pages show the whole run, the longer the more coarsely. Of events, and of lists of
/// objects that a later one replaces, the oldest are dropped. The newest list of objects and the robots that were added
/// are kept, because later moments refer to them.
class LiveHistory {
 public:
  static constexpr std::size_t kMaxMoments = 3000;
  static constexpr std::size_t kMaxMoments_bytes = 16UL << 20U;
  /// Of events and replaced lists of objects.
  static constexpr std::size_t kMaxPast_bytes = 4UL << 20U;
  /// A page that has shown the present and lacks more moments than this receives the newest one only.
  static constexpr std::size_t kMaxBehind = 50;
  /// Of a part.
  static constexpr std::size_t kPart_bytes = 256UL << 10U;

  void clear();
  void add(LiveItem item);
  /// Number of the last item; items have ascending numbers, from 1, also across clear().
  std::uint64_t last() const { return last_; }

  /// Items after a number, in their order.
  struct Part {
    std::vector<std::shared_ptr<const std::string>> texts;  ///< JSON
    std::uint64_t up_to = 0;                                ///< number of the last one, or of one that was left out
    std::size_t left_out = 0;                               ///< moments
    /// The texts, separated by commas.
    std::string items() const;
  };
  /// The items after a number, at most about kPart_bytes; nullopt if there are none.
  /// @param may_leave_out whether moments are left out if there are more than kMaxBehind
  std::optional<Part> after(std::uint64_t number, bool may_leave_out) const;

  std::size_t moments() const { return moments_; }
  std::size_t bytes() const { return moment_bytes_ + past_bytes_ + kept_bytes_; }

 private:
  struct Entry {
    std::uint64_t number;
    LiveItemKind kind;
    std::shared_ptr<const std::string> text;
    bool isMoment() const { return kind == LiveItemKind::moment; }
  };
  bool isPast(const Entry& entry) const;
  void thin();
  void dropOldest();

  std::deque<Entry> entries_;
  std::uint64_t last_ = 0;
  std::uint64_t objects_ = 0;      ///< number of the newest list of objects; 0: none
  std::size_t objects_bytes_ = 0;  ///< of it
  std::size_t moments_ = 0;
  std::size_t moment_bytes_ = 0;
  std::size_t past_bytes_ = 0;  ///< of what is dropped beyond kMaxPast_bytes
  std::size_t kept_bytes_ = 0;  ///< of what is never dropped
};

}  // namespace robosim
