#include "viewing/view_page.h"

#include <chrono>
#include <deque>
#include <random>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/interrupt.h"
#include "base/log.h"
#include "live_page/live_encoding.h"
#include "live_page/live_messages.h"
#include "replay/read_recording.h"
#include "serving/page_serving.h"

namespace robosim {
namespace {

/// Between two looks at pages and source.
constexpr std::chrono::milliseconds kRest(10);

/// A source and its pages.
class ViewedPage {
 public:
  ViewedPage(ViewSource& source, const LivePageServer::Options& options) : source_(source), server_(options) {
    options.log(livePageLine(options, server_.port()));
    begin();
  }

  void serve(const Interrupt& interrupt) {
    while (!interrupt.isRequested()) {
      handleRequests();
      if (source_.advance(0)) noteMoment();
      const auto now = Clock::now();
      if (is_due_ && now - sent_ >= PageServing::kMomentPeriod) send();
      std::this_thread::sleep_for(kRest);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  void begin() {
    world_number_ = source_.worldNumber();
    const std::string id = std::to_string(std::random_device()());
    encoding_.emplace(id, source_.title(), source_.world().world, source_.world().fleet);
    server_.hub().begin(id, encoding_->description());
    events_.clear();
    noteMoment();
    send();
  }

  void noteMoment() {
    if (source_.worldNumber() != world_number_) {
      if (!canContinue()) return begin();
      addRobots();
    }
    std::vector<const Readings*> readings;
    for (const auto& robot : source_.snapshot().robots) readings.push_back(robot.readings ? &*robot.readings : nullptr);
    addMessages(source_.world().fleet, readings, events_);
    is_due_ = true;
  }

  /// Whether the source's world is that of the run on the pages, to which robots may have been added.
  bool canContinue() const {
    return source_.snapshot().time_s >= shown_s_ && encoding_->canBeOf(source_.world().world, source_.world().fleet);
  }

  void addRobots() {
    world_number_ = source_.worldNumber();
    auto items = encoding_->addRobots(source_.world().fleet);
    if (items.empty()) return;
    server_.hub().describe(encoding_->description());
    server_.hub().add(std::move(items));
  }

  void send() {
    const RunSnapshot& snapshot = source_.snapshot();
    const auto& robots = source_.world().fleet.robots;
    LiveMoment moment{snapshot.time_s, {}, snapshot.objects, std::exchange(events_, {})};
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (i >= snapshot.robots.size()) {
        moment.robots.push_back({{}, {.activity = Activity::absent}});
        continue;
      }
      const RobotSnapshot& robot = snapshot.robots[i];
      const bool has_won = robot.readings && robot.readings->winner == robots[i].info.name;
      moment.robots.push_back({robot.world_from_robot,
                               {robot.activity, robot.stalled, has_won, false, robot.led_color},
                               robot.readings ? &*robot.readings : nullptr});
    }
    server_.hub().add(encoding_->add(moment));
    shown_s_ = snapshot.time_s;
    is_due_ = false;
    sent_ = Clock::now();
  }

  void handleRequests() {
    for (auto& request : server_.hub().takeRequests()) {
      if (const auto* const place = std::get_if<PlaceBody>(&request.action)) {
        if (const std::string why = source_.whyUnchangeable(); !why.empty()) {
          server_.hub().answer(request, why);
        } else {
          source_.change(*place);
          unanswered_.push_back(std::move(request));
        }
      } else {
        server_.hub().answer(request, operate(request.action));
      }
    }
    for (const std::string& fault : source_.takeAnswers()) {
      if (unanswered_.empty()) break;
      server_.hub().answer(unanswered_.front(), fault);
      unanswered_.pop_front();
    }
    server_.hub().setControl({.is_paused = source_.canPlay() && source_.isPaused(),
                              .is_over = source_.isOver(),
                              .speed = source_.speed(),
                              .why_not_operated = whyNotOperated(),
                              .why_not_supervised = source_.whyUnchangeable()});
  }

  std::string whyNotOperated() const {
    if (source_.canPlay()) return "";
    return source_.isOver() ? "nothing runs here" : "robosim view has no token that permits it";
  }

  /// @return why not; empty if it is done
  std::string operate(const LiveAction& action) {
    if (std::string why = whyNotOperated(); !why.empty()) return why;
    if (const auto* const pause = std::get_if<PauseRun>(&action)) {
      source_.pause(pause->on);
    } else if (const auto* const to = std::get_if<SetRunSpeed>(&action)) {
      if (std::string fault = speedFault(to->speed, false); !fault.empty()) return fault;
      source_.setSpeed(to->speed);
    } else {
      source_.step();
    }
    return "";
  }

  ViewSource& source_;
  LivePageServer server_;
  std::optional<LiveEncoding> encoding_;
  std::vector<LiveEvent> events_;       ///< since the last moment that was sent
  std::deque<LiveRequest> unanswered_;  ///< places, in the order in which the source answers
  int world_number_ = 0;
  double shown_s_ = 0;  ///< time of the last moment that was sent
  bool is_due_ = false;
  Clock::time_point sent_;
};

}  // namespace

void serveViewPage(ViewSource& source, const LivePageServer::Options& options) {
  const Interrupt interrupt;
  if (const auto remark = source.remark(); !remark.empty()) logWarning("view", remark);
  ViewedPage(source, options).serve(interrupt);
}

bool serveRecordingPage(const std::string& file, const LivePageServer::Options& options) {
  const Interrupt interrupt;
  const auto check = [&] {
    if (interrupt.isRequested()) throwIfInterrupted("no page is served");
  };
  RecordingContents contents =
      readRecording(file, {.table = false, .figure = false, .page = true}, [&](std::uint64_t) { check(); });
  for (const auto& assumption : contents.assumptions) contents.page->addRemark(assumption);
  if (contents.read_error) {
    logWarning("view", *contents.read_error);
    contents.page->addRemark(*contents.read_error);
  }
  std::vector<std::pair<std::string, std::string>> blocks;
  for (auto& block : contents.page->blocks([&](const std::string&) { check(); })) {
    blocks.emplace_back(std::move(block.id), std::move(block.text));
  }
  LivePageServer server(options);
  server.hub().setRecording(blocks);
  options.log(livePageLine(options, server.port()));
  while (!interrupt.isRequested()) std::this_thread::sleep_for(kRest);
  return !contents.is_damaged;
}

}  // namespace robosim
