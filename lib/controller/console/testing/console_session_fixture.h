#pragma once
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include "console/testing/console_harness.h"

namespace robosim {

/// @file
/// Fixtures of the tests of ConsoleSession.

inline constexpr const char* kViewer = "viewer-0123456789abcdef";
inline constexpr const char* kOnlyAnn = "only-ann-0123456789abcdef";
inline constexpr const char* kOnlyBob = "only-bob-0123456789abcdef";
inline constexpr const char* kAnnAndBob = "ann-and-bob-0123456789abcdef";
inline constexpr const char* kOperator = "operator-0123456789abcdef";
inline constexpr const char* kOneDay = "one-day-0123456789abcdef";
/// Tests start at 01:00 on 2027-01-01: the last token expires 23 hours later.
inline constexpr const char* kTokens =
    "viewer-0123456789abcdef viewer\n"
    "only-ann-0123456789abcdef robot Ann\n"
    "only-bob-0123456789abcdef robot Bob\n"
    "ann-and-bob-0123456789abcdef robot Ann Bob\n"
    "operator-0123456789abcdef operator\n"
    "one-day-0123456789abcdef operator expires=2027-01-01\n";

inline std::string textOf(const v1::ControlRequest& order) {
  std::string text = rowOf(typeOf(order)).name;
  if (order.drive().has_speed_mps()) text += mrpt::format(" speed %g", order.drive().speed_mps());
  if (order.drive().has_turn_radps()) text += mrpt::format(" turn %g", order.drive().turn_radps());
  return text + (order.stop().why().empty() ? "" : ": " + order.stop().why());
}

/// Ann, the primary, Bob and Cid. Ann's maximum speeds are 1 m/s and 2 rad/s.
struct ConsoleSessionTest : testing::Test {
  explicit ConsoleSessionTest(const std::string& tokens = "") : console(tokens) {}

  /// The orders since the last call, such as "Ann drive speed 0.5, Ann stop".
  std::string orders() {
    std::string text;
    for (const auto& [robot, order] : console.takeOrders()) {
      text += (text.empty() ? "" : ", ") + robot + " " + textOf(order);
    }
    return text;
  }
  /// A page in control.
  PageId driver(const std::string& name = "Ada", const std::string& token = "") {
    const PageId id = console.join(token, name);
    console.send(id, R"({"type":"take"})");
    console.read(id);
    console.tick(std::chrono::seconds(1));
    return id;
  }
  /// Whether a page has received a text since the beginning.
  bool received(PageId id, std::string_view text) {
    console.read(id);
    return console.page(id).has(text);
  }
  PageId holder() const { return console.session.lockHolder(); }

  ConsoleHarness console;
};

/// The same with tokens: kTokens.
struct ConsoleSessionTokensTest : ConsoleSessionTest {
  ConsoleSessionTokensTest() : ConsoleSessionTest(kTokens) {}
};

}  // namespace robosim
