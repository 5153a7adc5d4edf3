#include "console/page_outbox.h"

#include <utility>

#include "console/page_json.h"

namespace robosim {
namespace {

WebMessagePtr textMessage(const std::string& text) {
  return std::make_shared<const WebMessage>(WebMessage::text(text));
}

}  // namespace

bool PageOutbox::reply(const std::string& text) {
  if (queue_.size() >= kMaxQueued) return false;
  queue_.push_back(textMessage(text));
  return true;
}

void PageOutbox::note(WebMessagePtr message) {
  if (queue_.size() < kMaxNotes) queue_.push_back(std::move(message));
}

void PageOutbox::subscribeMap(bool on) {
  subscription_.map = on;
  map_ = 0;
  poses_.reset();
}

bool PageOutbox::acknowledge(std::uint64_t number, Time now) {
  if (number > sent_) return false;
  if (number <= acknowledged_) return true;  // no progress
  acknowledged_ = number;
  waiting_since_ = now;
  return true;
}

bool PageOutbox::isStuck(Time now) const { return sent_ > acknowledged_ && now - waiting_since_ > kAckWithin; }

bool PageOutbox::isUpdateDue(const ConsoleFeed& feed, Time now) const {
  const RobotNews& news = feed.primary;
  if (!news.update || !news.info || news.update == update_ || unacknowledged() >= kMaxUnacknowledged) return false;
  return news.picture != picture_ || now - update_sent_ >= kUpdatePeriod;
}

WebMessagePtr PageOutbox::next(ConsoleFeed& feed, bool is_admitted, Time now) {
  WebMessagePtr message = nextNews(feed, is_admitted, now);
  if (!message && is_admitted && isPulseDue(now)) message = textMessage(pulseJson());
  if (message) spoken_ = now;
  return message;
}

WebMessagePtr PageOutbox::nextNews(ConsoleFeed& feed, bool is_admitted, Time now) {
  if (!queue_.empty()) {
    WebMessagePtr message = std::move(queue_.front());
    queue_.pop_front();
    return message;
  }
  if (!is_admitted) return nullptr;
  if (std::exchange(robot_, feed.robot.version) != feed.robot.version) return feed.robot.message;
  if (std::exchange(team_, feed.team.version) != feed.team.version) return feed.team.message;
  if (std::exchange(vitals_, feed.vitals.version) != feed.vitals.version) return feed.vitals.message;
  if (std::exchange(run_, feed.run.version) != feed.run.version) return feed.run.message;
  if (std::exchange(game_, feed.game.version) != feed.game.version) return feed.game.message;
  if (isUpdateDue(feed, now)) return nextUpdate(feed, now);
  return subscription_.map && feed.poses ? nextOfMap(feed, now) : nullptr;
}

WebMessagePtr PageOutbox::nextUpdate(ConsoleFeed& feed, Time now) {
  const RobotNews& news = feed.primary;
  const bool has_picture = news.picture && news.picture != picture_;
  if (sent_ == acknowledged_) waiting_since_ = now;
  update_ = news.update;
  picture_ = news.picture;
  update_sent_ = now;
  ++sent_;
  return feed.updates.of(news, has_picture, subscription_.sensors);
}

WebMessagePtr PageOutbox::nextOfMap(const ConsoleFeed& feed, Time now) {
  if (std::exchange(map_, feed.map.version) != feed.map.version) {
    poses_.reset();
    return feed.map.message;
  }
  if (!feed.poses->world || feed.poses == poses_ || now - poses_sent_ < kPosesPeriod) return nullptr;
  const auto sent = std::exchange(poses_, feed.poses);
  poses_sent_ = now;
  return textMessage(posesJson(*feed.poses, sent.get()));
}

}  // namespace robosim
