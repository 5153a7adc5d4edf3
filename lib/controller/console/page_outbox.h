#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "console/console_feed.h"
#include "web/message.h"

namespace robosim {

/// Messages of the console that wait for one page. Bounded, however slowly the page reads:
///
/// - Replies to the page's own messages are never dropped. A page with kMaxQueued messages in its queue that causes a
///   further reply is to be disconnected.
/// - Notes to all pages are dropped while kMaxNotes messages are queued, so that others cannot cause a disconnection.
/// - Of state (robot, team, map, poses, updates with pictures) the outbox refers to the newest only, in the feed that
///   all pages share. A page that reads slowly receives fewer updates, and pictures that were superseded are dropped.
/// - At most kMaxUnacknowledged updates are sent ahead of the page's acknowledgements. A page that acknowledges none
///   for kAckWithin is to be disconnected.
/// - After kPulsePeriod without a message a pulse is due, so that the page can distinguish silence from a broken
///   connection.
///
/// Time is a parameter.
class PageOutbox {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kMaxNotes = 50;
  static constexpr std::size_t kMaxQueued = 64;
  static constexpr std::uint64_t kMaxUnacknowledged = 3;  ///< covers the transmission time of a message
  static constexpr std::chrono::seconds kAckWithin{6};
  static constexpr std::chrono::milliseconds kUpdatePeriod{33};  ///< minimum, between updates without a new picture
  static constexpr std::chrono::milliseconds kPosesPeriod{100};  ///< minimum
  static constexpr std::chrono::milliseconds kPulsePeriod{250};  ///< maximum time without a message

  /// What the page has subscribed to.
  struct Subscription {
    bool sensors = true;  ///< readings with every update, not only on request
    bool map = false;     ///< true poses
  };

  /// Queues a reply. @return false if the queue is full: the page is to be disconnected
  bool reply(const std::string& json);
  /// Queues a note for all pages, or drops it.
  void note(WebMessagePtr message);
  void subscribeSensors(bool on) { subscription_.sensors = on; }
  void subscribeMap(bool on);
  const Subscription& subscription() const { return subscription_; }

  /// The page has drawn all updates up to this number, counted from 1.
  /// @return false if no update of that number was sent
  bool acknowledge(std::uint64_t number, Time now);
  /// Whether an update has been unacknowledged for longer than kAckWithin.
  bool isStuck(Time now) const;
  /// Whether next() returns an update once the queue is empty.
  bool isUpdateDue(const ConsoleFeed& feed, Time now) const;

  /// Whether next() returns a pulse if there is no other message.
  bool isPulseDue(Time now) const { return spoken_ && now - *spoken_ >= kPulsePeriod; }

  /// The next message to send; null for none. To be called when the connection accepts a message, so that outdated
  /// state is never sent.
  /// @param is_admitted whether the page receives the feed, besides its queue
  WebMessagePtr next(ConsoleFeed& feed, bool is_admitted, Time now);

  std::size_t queued() const { return queue_.size(); }
  std::uint64_t unacknowledged() const { return sent_ - acknowledged_; }

 private:
  WebMessagePtr nextNews(ConsoleFeed& feed, bool is_admitted, Time now);
  WebMessagePtr nextUpdate(ConsoleFeed& feed, Time now);
  WebMessagePtr nextOfMap(const ConsoleFeed& feed, Time now);

  std::deque<WebMessagePtr> queue_;
  Subscription subscription_;
  /// @name State already sent
  ///@{
  std::uint64_t robot_ = 0, team_ = 0, vitals_ = 0, run_ = 0, game_ = 0, map_ = 0;  ///< versions
  std::shared_ptr<const RobotUpdate> update_;
  std::shared_ptr<const RobotPicture> picture_;
  std::shared_ptr<const MapView> poses_;
  Time update_sent_, poses_sent_;
  std::optional<Time> spoken_;  ///< time of the last message
  ///@}
  std::uint64_t sent_ = 0, acknowledged_ = 0;  ///< updates
  Time waiting_since_;                         ///< time of the last acknowledgement, or of the first update after it
};

}  // namespace robosim
