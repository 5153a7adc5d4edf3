#include "console/page_authorization.h"

#include <array>
#include <span>

namespace robosim {
namespace {

using Type = PageMessage::Type;
using MessageRight = MessageRule::Right;
using Result = Authorization::Result;

using Page = MessageRule::Page;
using Primary = MessageRule::Primary;

/// `stop`, `alive` and `release` are permitted during a switch, so that no stop is lost.
constexpr std::array<MessageRule, PageMessage::kTypes> kRules{{
    {Type::hello, MessageRight::none, Page::any, Primary::any},
    {Type::ack, MessageRight::none, Page::admitted, Primary::any},
    {Type::ping, MessageRight::none, Page::admitted, Primary::any},
    {Type::live, MessageRight::none, Page::admitted, Primary::any},
    {Type::map, MessageRight::look, Page::admitted, Primary::any},
    {Type::req_heat, MessageRight::none, Page::admitted, Primary::any},
    {Type::req_laser, MessageRight::none, Page::admitted, Primary::any},
    {Type::req_sonar, MessageRight::none, Page::admitted, Primary::any},
    {Type::take, MessageRight::drive_primary, Page::admitted, Primary::settled},
    {Type::release, MessageRight::none, Page::holds_lock, Primary::any},
    {Type::drive, MessageRight::drive_primary, Page::holds_lock, Primary::known},
    {Type::accelerate, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::decelerate, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::turn_left, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::turn_right, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::stop, MessageRight::drive_primary, Page::holds_lock, Primary::any},
    {Type::alive, MessageRight::drive_primary, Page::holds_lock, Primary::any},
    {Type::check_win, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::autonomous, MessageRight::drive_primary, Page::holds_lock, Primary::settled},
    {Type::switch_primary, MessageRight::drive_primary_and_target, Page::holds_lock, Primary::settled},
    {Type::play_again, MessageRight::operate, Page::holds_lock, Primary::any},
    {Type::record, MessageRight::operate, Page::holds_lock, Primary::any},
}};

constexpr bool isRuleAtItsIndex() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    if (static_cast<std::size_t>(kRules[i].type) != i) return false;
  }
  return true;
}
static_assert(isRuleAtItsIndex(), "a type's rule is at its index");

/// Why a token lacks a right; empty when it has it.
std::string denial(const Access& access, const Identity& client, const PageState& state, const PageMessage& message) {
  const MessageRight right = ruleOf(message.type).right;
  if (right == MessageRight::none) return "";
  if (right == MessageRight::look) {
    return mayLook(access, client) ? "" : "Your token does not permit the map, which shows true poses.";
  }
  if (right == MessageRight::operate) {
    if (mayOperate(access, client)) return "";
    return message.type == Type::record ? "Your token does not permit recording the run."
                                        : "Your token does not permit starting a run.";
  }
  if (!mayDrive(access, client, state.primary)) {
    return mayLook(access, client) ? "Your token permits watching, not driving."
                                   : "Your token is not for " + state.primary + ".";
  }
  const bool names_target = right == MessageRight::drive_primary_and_target && !message.robot.empty();
  if (names_target && !mayDrive(access, client, message.robot)) return "Your token is not for " + message.robot + ".";
  return "";
}

}  // namespace

const MessageRule& ruleOf(PageMessage::Type type) { return kRules[static_cast<std::size_t>(type)]; }

Authorization authorize(const Access& access, const Identity& client, const PageState& state,
                        const PageMessage& message) {
  const MessageRule& rule = ruleOf(message.type);
  if (rule.page != Page::any && !state.is_admitted) {
    return {Result::protocol_error, "the first message of a page must be its hello"};
  }
  if (rule.page == Page::holds_lock && !state.holds_lock) return {Result::ignored, ""};
  if (const std::string why = denial(access, client, state, message); !why.empty()) return {Result::denied, why};
  if (rule.primary != Primary::any && state.is_switching) return {Result::ignored, ""};
  if (rule.primary == Primary::known && !state.is_primary_known) return {Result::ignored, ""};
  return {};
}

bool mayLook(const Access& access, const Identity& client) { return access.check(client, robosim::Right::look).ok(); }

bool mayDrive(const Access& access, const Identity& client, const std::string& robot) {
  return access.check(client, robosim::Right::drive, std::span(&robot, 1)).ok();
}

bool mayOperate(const Access& access, const Identity& client) {
  return access.check(client, robosim::Right::operate).ok();
}

bool mayJoin(const Access& access, const Identity& client) {
  return mayLook(access, client) || access.check(client, robosim::Right::drive).ok();
}

}  // namespace robosim
