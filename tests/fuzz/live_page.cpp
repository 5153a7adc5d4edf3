// Fuzzes the messages of pages of a live run: a page for each role, one with a token that permits nothing here, and one
// that has sent no hello, send texts to a LivePageHub. Aborts when a request reaches the run that the page's token does
// not permit, or when what waits for a page or for the run exceeds its limits.
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>

#include "live_page/live_page_hub.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

namespace {

constexpr PageId kViewer = 1, kOperator = 2, kSupervisor = 3, kDriver = 4, kSilent = 5;
constexpr std::array kPages{kViewer, kOperator, kSupervisor, kDriver, kSilent};
constexpr const char* kTokens =
    "viewer-0123456789abcdef viewer\n"
    "operator-0123456789abcdef operator\n"
    "supervisor-0123456789abcdef supervisor\n"
    "driver-0123456789abcdef robot Ann\n";

std::string hello(const std::string& role) { return R"({"type":"hello","token":")" + role + R"(-0123456789abcdef"})"; }

bool isPermitted(const LiveRequest& request) {
  return request.page == (std::holds_alternative<PlaceBody>(request.action) ? kSupervisor : kOperator);
}

}  // namespace

/// Messages are separated by a byte 0xff; the first byte of each selects the page, and what happens then.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  if (rest.find("0123456789abcdef") != std::string_view::npos) return 0;  // no page knows the token of another
  LivePageHub hub({.access = Access::parse(kTokens, "tokens")});
  hub.begin("1", "{}");
  hub.setControl({});
  for (const PageId page : kPages) hub.pageOpened(page, "192.0.2." + std::to_string(page));
  hub.pageText(kViewer, hello("viewer"));
  hub.pageText(kOperator, hello("operator"));
  hub.pageText(kSupervisor, hello("supervisor"));
  hub.pageText(kDriver, hello("driver"));
  std::size_t requests = 0;
  const auto check = [&] {
    const auto taken = hub.takeRequests();
    if (taken.size() > LivePageHub::kMaxRequests) std::abort();
    for (const auto& request : taken) {
      if (!isPermitted(request)) std::abort();
      hub.answer(request, requests++ % 2 == 0 ? "" : "refused");
    }
  };
  while (!rest.empty()) {
    const auto end = rest.find('\xff');
    const std::string_view message = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (message.empty()) continue;
    const auto first = static_cast<unsigned char>(message[0]);
    const PageId page = kPages[first % kPages.size()];
    hub.pageText(page, message.substr(1));
    hub.add({{"0", LiveItemKind::moment}});
    if (first & 16U) hub.nextMessage(page);
    if (first & 32U) check();
    if (first & 64U) hub.tick();
    if (!(first & 128U)) continue;
    for (const auto& [leaving, why] : hub.takeLeaving()) hub.pageClosed(leaving);
  }
  check();
  for (const PageId page : kPages) {
    std::size_t waiting = 0;
    while (hub.nextMessage(page)) ++waiting;
    // Replies, the run, its control, and the items; without a hello that permits watching, a refusal.
    if (waiting > (page < kDriver ? LivePageHub::kMaxReplies + 3 : 1)) std::abort();
  }
  return 0;
}
