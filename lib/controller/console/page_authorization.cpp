#include "console/page_authorization.h"

#include <span>

namespace robosim {
namespace {

using Result = Authorization::Result;
using Needs = PageMessageRow::Right;
using Page = PageMessageRow::Page;

/// Why a token lacks a right; empty when it has it.
std::string denial(const Access& access, const Identity& client, const PageState& state, const PageMessage& message) {
  const Needs right = rowOf(message.type).right;
  if (right == Needs::none) return "";
  if (right == Needs::look) {
    return mayLook(access, client) ? "" : "Your token does not permit the map, which shows true poses.";
  }
  if (right == Needs::operate) {
    if (mayOperate(access, client)) return "";
    if (message.type == PageMessage::Type(ConsoleRequest::skip)) return "Your token does not permit ending a round.";
    return message.type == PageMessage::Type(ConsoleRequest::record) ? "Your token does not permit recording the run."
                                                                     : "Your token does not permit starting a run.";
  }
  if (!mayDrive(access, client, state.primary)) {
    return mayLook(access, client) ? "Your token permits watching, not driving."
                                   : "Your token is not for " + state.primary + ".";
  }
  const bool names_target = right == Needs::drive_primary_and_target && !message.robot.empty();
  if (names_target && !mayDrive(access, client, message.robot)) return "Your token is not for " + message.robot + ".";
  return "";
}

}  // namespace

Authorization authorize(const Access& access, const Identity& client, const PageState& state,
                        const PageMessage& message) {
  const PageMessageRow& row = rowOf(message.type);
  if (row.page != Page::any && !state.is_admitted) {
    return {Result::protocol_error, "the first message of a page must be its hello"};
  }
  if (row.page == Page::holds_lock && !state.holds_lock) return {Result::ignored, ""};
  if (const std::string why = denial(access, client, state, message); !why.empty()) return {Result::denied, why};
  if (row.primary != PrimaryState::any && state.is_switching) return {Result::ignored, ""};
  if (row.primary == PrimaryState::known && !state.is_primary_known) return {Result::ignored, ""};
  return {};
}

bool mayLook(const Access& access, const Identity& client) { return access.check(client, Right::look).ok(); }

bool mayDrive(const Access& access, const Identity& client, const std::string& robot) {
  return access.check(client, Right::drive, std::span(&robot, 1)).ok();
}

bool mayOperate(const Access& access, const Identity& client) { return access.check(client, Right::operate).ok(); }

bool mayJoin(const Access& access, const Identity& client) {
  return mayLook(access, client) || access.check(client, Right::drive).ok();
}

}  // namespace robosim
