#include "live_page/live_history.h"

#include <algorithm>
#include <utility>

namespace robosim {

void LiveHistory::clear() {
  entries_.clear();
  objects_ = 0;
  objects_bytes_ = moments_ = moment_bytes_ = past_bytes_ = kept_bytes_ = 0;
}

void LiveHistory::add(LiveItem item) {
  const std::size_t size = item.text.size();
  ++last_;
  switch (item.kind) {
    case LiveItemKind::moment:
      ++moments_;
      moment_bytes_ += size;
      break;
    case LiveItemKind::event:
      past_bytes_ += size;
      break;
    case LiveItemKind::objects:
      past_bytes_ += objects_bytes_;
      kept_bytes_ += size - objects_bytes_;
      objects_ = last_;
      objects_bytes_ = size;
      break;
    case LiveItemKind::robots:
      kept_bytes_ += size;
      break;
  }
  entries_.push_back({last_, item.kind, std::make_shared<const std::string>(std::move(item.text))});
  while (moments_ > 2 && (moments_ > kMaxMoments || moment_bytes_ > kMaxMoments_bytes)) thin();
  while (past_bytes_ > kMaxPast_bytes) dropOldest();
}

bool LiveHistory::isPast(const Entry& entry) const {
  return entry.kind == LiveItemKind::event || (entry.kind == LiveItemKind::objects && entry.number != objects_);
}

/// Drops every second moment, and keeps the first and the newest.
void LiveHistory::thin() {
  std::size_t index = 0;
  const std::size_t newest = moments_ - 1;
  std::erase_if(entries_, [&](const Entry& entry) {
    if (!entry.isMoment()) return false;
    const std::size_t i = index++;
    if (i % 2 == 0 || i == newest) return false;
    --moments_;
    moment_bytes_ -= entry.text->size();
    return true;
  });
}

void LiveHistory::dropOldest() {
  const auto oldest =
      std::find_if(entries_.begin(), entries_.end(), [this](const Entry& entry) { return isPast(entry); });
  past_bytes_ -= oldest->text->size();
  entries_.erase(oldest);
}

std::string LiveHistory::Part::items() const {
  std::size_t size = 0;
  for (const auto& text : texts) size += text->size() + 1;
  std::string items;
  items.reserve(size);
  for (const auto& text : texts) {
    if (!items.empty()) items += ',';
    items += *text;
  }
  return items;
}

std::optional<LiveHistory::Part> LiveHistory::after(std::uint64_t number, bool may_leave_out) const {
  auto entry = std::upper_bound(entries_.begin(), entries_.end(), number,
                                [](std::uint64_t than, const Entry& e) { return than < e.number; });
  if (entry == entries_.end()) return std::nullopt;
  const auto count =
      static_cast<std::size_t>(std::count_if(entry, entries_.end(), [](const Entry& e) { return e.isMoment(); }));
  std::size_t skipped = may_leave_out && count > kMaxBehind ? count - 1 : 0;
  Part part;
  for (std::size_t size = 0; entry != entries_.end() && size < kPart_bytes; ++entry) {
    part.up_to = entry->number;
    if (entry->isMoment() && skipped > 0) {
      --skipped;
      ++part.left_out;
      continue;
    }
    size += entry->text->size();
    part.texts.push_back(entry->text);
  }
  return part;
}

}  // namespace robosim
