#include "server/robot_inboxes.h"

namespace robosim {

void RobotInboxes::reset(std::size_t robots) {
  inboxes_.clear();
  inboxes_.resize(robots);
  dropped_ = 0;
}

void RobotInboxes::drop(Inbox& inbox) {
  inbox.bytes -= inbox.items.front().message.text.size();
  inbox.items.pop_front();
}

void RobotInboxes::add(std::size_t robot, std::uint64_t step, const std::vector<RobotMessage>& messages) {
  Inbox& inbox = inboxes_[robot];
  for (const auto& message : messages) {
    inbox.items.push_back({step, message});
    inbox.bytes += message.text.size();
  }
  // Messages of the newest step are never dropped: the bound applies to the backlog of unanswered steps.
  while ((inbox.items.size() > kMessagesMax || inbox.bytes > kBytesMax) && inbox.items.front().step < step) {
    drop(inbox);
    ++dropped_;
  }
}

void RobotInboxes::confirm(std::size_t robot, std::uint64_t step) {
  Inbox& inbox = inboxes_[robot];
  while (!inbox.items.empty() && inbox.items.front().step <= step) drop(inbox);
}

std::vector<RobotMessage> RobotInboxes::unconfirmed(std::size_t robot) const {
  std::vector<RobotMessage> messages;
  for (const auto& item : inboxes_[robot].items) messages.push_back(item.message);
  return messages;
}

}  // namespace robosim
