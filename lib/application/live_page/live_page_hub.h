#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/log_limiter.h"
#include "live_page/live_history.h"
#include "net/access.h"
#include "net/audit.h"
#include "web/message.h"
#include "world/intervention.h"

namespace robosim {

/// @name What a page may ask for
///@{
struct PauseRun {
  bool on = false;
};
struct StepOnce {};
struct SetRunSpeed {
  double speed = 1;  ///< simulated seconds per second; 0: unlimited
};
using LiveAction = std::variant<PauseRun, StepOnce, SetRunSpeed, PlaceBody>;
///@}

/// A request of a page, whose token permits it, for the run's thread.
struct LiveRequest {
  PageId page = 0;
  std::uint64_t id = 0;  ///< of the page, for the answer
  std::string author;    ///< name of the token
  LiveAction action;
};

/// Whether a run is paused, how fast it is, and what cannot be changed whatever the token.
struct LiveControl {
  bool is_paused = false, is_over = false;
  double speed = 1;
  std::string why_not_operated = {}, why_not_supervised = {};  ///< empty if clients with the right can
  bool operator==(const LiveControl&) const = default;
};

/// The pages that show a run, and what waits for them. One thread, the run's, adds items and takes requests; the web
/// server's thread calls the functions of pages. The run never waits for a page: all pages share one LiveHistory, in
/// which each has a place, and messages are parsed, assembled and logged outside the lock that both threads use. A page
/// that reads slowly lacks moments, and never makes others wait.
///
/// Messages of pages are untrusted. A page first sends its token; without one that permits watching it receives
/// nothing. Requests are checked against the present tokens, and logged for audits.
class LivePageHub {
 public:
  static constexpr const char* kProtocol = "robosim.live.1";  ///< WebSocket subprotocol
  static constexpr std::size_t kMaxRequests = 64;             ///< that wait for the run
  static constexpr std::size_t kMaxReplies = 64;              ///< that wait for a page
  static constexpr std::size_t kMaxMessage_bytes = 4096;      ///< of a page
  static constexpr std::chrono::seconds kHelloWithin{5};
  using Clock = std::chrono::steady_clock;

  struct Options {
    Access access;                                                            ///< rights by token
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe
    std::function<void()> on_news = [] {};  ///< messages wait for pages; called in the run's thread
    std::function<Clock::time_point()> now = Clock::now;
  };
  explicit LivePageHub(Options options) : options_(std::move(options)) {}

  /// @name Of the run
  ///@{
  /// Another run. @param id of it @param description as of LiveEncoding::description()
  void begin(const std::string& id, const std::string& description);
  /// The same run, in which robots have been added: for pages that are opened later.
  void describe(const std::string& description);
  void add(std::vector<LiveItem> items);
  void setControl(const LiveControl& control);
  /// A recording instead of a run: blocks of RunPage, by id. Each page receives them.
  void setRecording(const std::vector<std::pair<std::string, std::string>>& blocks);
  std::vector<LiveRequest> takeRequests();
  /// @param fault why the request has no effect; empty if it has
  void answer(const LiveRequest& request, const std::string& fault);
  ///@}

  /// @name Of the web server, in its thread
  ///@{
  void pageOpened(PageId page, const std::string& peer);
  void pageClosed(PageId page);
  void pageText(PageId page, std::string_view text);
  void pageInvalid(PageId page, const std::string& why);
  WebMessagePtr nextMessage(PageId page);
  /// Checks tokens, and pages that have not sent one. Call about 20 times per second.
  void tick();
  /// Pages for which messages wait.
  std::vector<PageId> waitingPages() const;
  /// Pages that are to be disconnected, with the reason; each once.
  std::vector<std::pair<PageId, std::string>> takeLeaving();
  ///@}

 private:
  struct Page {
    std::string peer;
    Identity identity;
    Clock::time_point opened_at;
    bool is_admitted = false, is_leaving = false;
    std::deque<WebMessagePtr> replies;
    std::uint64_t run = 0, control = 0, recorded = 0;  ///< what it has received: versions; blocks
    std::uint64_t item = 0;                            ///< the last one that it has received
    std::uint64_t present = 0;                         ///< item from which on it shows the present
  };

  /// What a message of items contains.
  struct SharedItems {
    std::uint64_t after = 0, up_to = 0;
    std::size_t left_out = 0;
    bool is_present = false;
    bool operator==(const SharedItems&) const = default;
  };

  /// @name Without the lock while they authenticate and log
  ///@{
  void hello(PageId id, const std::string& token, bool has_token, const std::string& run, std::uint64_t item);
  void request(PageId id, std::uint64_t number, LiveAction action);
  ///@}
  WebMessagePtr itemsMessage(std::uint64_t after, const LiveHistory::Part& part, bool is_present);
  bool hasNews(const Page& page) const;
  Page* find(PageId id);
  void reply(PageId id, Page& page, const std::string& text);
  void replyFault(PageId id, Page& page, std::uint64_t request, const std::string& fault);
  void refuse(PageId id, Page& page, const std::string& why);
  void disconnect(PageId id, Page& page, const std::string& why);
  std::string whyNot(const Page& page, Right right) const;
  std::string controlText(const Page& page) const;

  Options options_;
  LogLimiter log_{options_.log};
  AuditLog audit_{options_.log};
  mutable std::mutex mutex_;
  /// @name Guarded by the mutex
  ///@{
  std::map<PageId, Page> pages_;
  LiveHistory history_;
  WebMessagePtr description_;                  ///< null: none
  std::string run_id_;                         ///< in it
  std::uint64_t run_ = 0, control_count_ = 0;  ///< versions
  std::uint64_t first_item_ = 0;               ///< items up to this are of former runs
  std::vector<WebMessagePtr> recorded_;        ///< parts of the blocks of a recording
  LiveControl control_;
  std::vector<LiveRequest> requests_;
  std::vector<std::pair<PageId, std::string>> leaving_;
  std::uint64_t access_version_ = 0;
  ///@}
  std::atomic<bool> has_requests_{false};  ///< whether requests_ may have some
  /// @name Of the web server's thread
  ///@{
  SharedItems shared_items_;      ///< of shared_message_
  WebMessagePtr shared_message_;  ///< the last message of items; null for none
  ///@}
};

}  // namespace robosim
