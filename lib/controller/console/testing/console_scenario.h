#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>

#include "console/testing/console_harness.h"

namespace robosim {

/// Events of a ConsoleSession that are selected by the bytes of an input: pages with different tokens that connect,
/// send valid and invalid messages and bursts of them, do not read, and disconnect, interleaved with time, robot
/// updates and failures. ConsoleHarness checks every state.
class ConsoleScenario {
 public:
  static constexpr std::size_t kMaxPages = 6;
  /// Queued messages, and one each of: robot, team, run, game, map, poses, pulse; and three updates.
  static constexpr std::size_t kMaxWaiting = PageOutbox::kMaxQueued + 10;

  /// Bytes of the input; zeros after its end.
  class Source {
   public:
    virtual ~Source() = default;
    virtual bool isEmpty() const = 0;
    virtual std::uint8_t next() = 0;
    std::size_t below(std::size_t bound) { return next() % bound; }
    std::string text(std::size_t size) {
      std::string text;
      while (text.size() < size && !isEmpty()) text += static_cast<char>(next());
      return text;
    }
  };

  /// One event.
  void act(Source& bytes) {
    constexpr std::size_t kinds = 16;
    const std::size_t kind = bytes.below(kinds);
    if (kind == 0 || harness.pages.empty()) return open();
    const auto selected = static_cast<std::ptrdiff_t>(bytes.below(harness.pages.size()));
    const PageId page = std::next(harness.pages.begin(), selected)->first;
    // As in the server, a page that is being disconnected closes soon.
    if (harness.page(page).is_leaving && kind % 2 == 0) return harness.close(page);
    switch (kind) {
      case 1:
      case 2:
        return harness.hello(page, kTokens[bytes.below(std::size(kTokens))]);
      case 3:
        return harness.send(page, bytes.text(bytes.below(256)));
      case 4:
        return harness.close(page);
      case 5:
      case 6:
        return harness.tick(std::chrono::milliseconds(bytes.below(250)));
      case 7:
        harness.read(page, bytes.below(kMaxWaiting));
        return;
      case 8:
        harness.run.may_restart = !harness.run.may_restart;
        return change(harness.row[bytes.below(harness.row.size())].news, bytes.below(4));
      case 9:
        return harness.step();
      case 10: {
        const std::size_t times = bytes.below(256);
        const std::size_t message = bytes.below(std::size(kMessages));
        for (std::size_t i = 0; i < times; ++i) harness.send(page, kMessages[message]);
        return;
      }
      default:
        return harness.send(page, kMessages[bytes.below(std::size(kMessages))]);
    }
  }

  /// All pages read what waits for them, and disconnect.
  void finish() {
    for (const auto& [id, page] : harness.pages) {
      if (harness.read(id, kMaxWaiting + 1) > kMaxWaiting) throw std::logic_error("violated: an outbox is bounded");
    }
    while (!harness.pages.empty()) harness.close(harness.pages.begin()->first);
    if (harness.session.lockHolder() != 0) throw std::logic_error("violated: no page, and no holder of the lock");
  }

  /// @param rounds of visitors; nullopt for none
  explicit ConsoleScenario(const std::optional<Rounds::Options>& rounds = std::nullopt)
      : harness(
            "viewer-0123456789abcdef viewer\n"
            "only-ann-0123456789abcdef robot Ann\n"
            "ann-and-bob-0123456789abcdef robot Ann Bob\n"
            "operator-0123456789abcdef operator\n",
            {"Ann", "Bob", "Cid"}, rounds) {}

  ConsoleHarness harness;

  static constexpr const char* kTokens[] = {"viewer-0123456789abcdef", "only-ann-0123456789abcdef",
                                            "ann-and-bob-0123456789abcdef", "operator-0123456789abcdef",
                                            "unknown-0123456789abcdef"};
  static constexpr const char* kMessages[] = {
      R"({"type":"take"})",
      R"({"type":"release"})",
      R"({"type":"drive","speed":1,"turn":-0.5})",
      R"({"type":"drive","turn":0.5,"pan":1})",
      R"({"type":"drive","speed":0})",
      R"({"type":"accelerate"})",
      R"({"type":"turn_left"})",
      R"({"type":"stop"})",
      R"({"type":"stop","why":"is hidden"})",
      R"({"type":"alive"})",
      R"({"type":"check_win"})",
      R"({"type":"req_heat"})",
      R"({"type":"autonomous","on":true})",
      R"({"type":"autonomous","on":false})",
      R"({"type":"switch"})",
      R"({"type":"switch","robot":"Ann"})",
      R"({"type":"switch","robot":"Bob"})",
      R"({"type":"switch","robot":"Cid"})",
      R"({"type":"play_again"})",
      R"({"type":"record","on":true})",
      R"({"type":"record","on":false})",
      R"({"type":"live","on":false})",
      R"({"type":"map","on":true})",
      R"({"type":"map","on":false})",
      R"({"type":"ack","number":1})",
  };

  /// Of a console with rounds.
  static constexpr const char* kRoundMessages[] = {
      R"({"type":"join","name":"Visitor","team":"Red"})",
      R"({"type":"join"})",
      R"({"type":"start"})",
      R"({"type":"leave"})",
      R"({"type":"skip"})",
  };

  void open() {
    // Addresses of their own, so that the limit on wrong tokens refuses few.
    if (harness.pages.size() < kMaxPages) harness.open("10.0.0." + std::to_string(++opened_ % 256));
  }

  /// A change of a robot's state that its link may report.
  static void change(RobotNews& news, std::size_t what) {
    switch (what) {
      case 0:
        news.is_up = !news.is_up;
        break;
      case 1:
        news.state.set_is_yours(!news.state.is_yours());
        news.state.set_driver(news.state.is_yours() ? "" : "another console");
        break;
      case 2:
        news.state.set_winner(news.state.winner().empty() ? "Bob" : "");
        break;
      default:
        news.state.set_why_stopped(news.state.why_stopped().empty() ? "a test" : "");
        break;
    }
  }

 private:
  std::size_t opened_ = 0;
};

}  // namespace robosim
