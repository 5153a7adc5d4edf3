#include "live_page/live_page_hub.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "run_page/page_world.h"

namespace robosim {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Of a message with a piece of a block: a connection must accept it within WebConnection::kWriteWithin.
constexpr std::size_t kPiece_bytes = 32UL << 10U;
/// To a page without a token, whose user can enter one.
constexpr const char* kTokenRequired = "This run requires a token; enter yours.";

WebMessagePtr shared(const std::string& text) { return std::make_shared<const WebMessage>(WebMessage::text(text)); }

/// The finite number of a member. @throws std::runtime_error
double numberOf(const json& message, const char* name) {
  const auto found = message.find(name);
  if (found == message.end() || !found->is_number() || !std::isfinite(found->get<double>())) {
    throw std::runtime_error(std::string("the member '") + name + "' must be a number");
  }
  return found->get<double>();
}

/// An unsigned member; 0 without it, or for another value.
std::uint64_t countOf(const json& message, const char* name) {
  const auto found = message.find(name);
  return found != message.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

std::string textOf(const json& message, const char* name) {
  const auto found = message.find(name);
  return found != message.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The action that a message requests; nullopt for a message of another type.
/// @throws std::runtime_error for invalid members
std::optional<LiveAction> actionOf(const std::string& type, const json& message) {
  if (type == "pause") {
    const auto on = message.find("on");
    if (on == message.end() || !on->is_boolean()) throw std::runtime_error("the member 'on' must be true or false");
    return PauseRun{on->get<bool>()};
  }
  if (type == "step") return StepOnce{};
  if (type == "speed") return SetRunSpeed{numberOf(message, "speed")};
  if (type != "place") return std::nullopt;
  PlaceBody place{textOf(message, "name"), numberOf(message, "x"), numberOf(message, "y")};
  if (place.name.empty()) throw std::runtime_error("the member 'name' must name a robot or an object");
  if (message.contains("heading")) place.heading_rad = numberOf(message, "heading");
  return place;
}

/// Of the audit log, as of other clients.
std::string auditText(const LiveAction& action) {
  return std::visit(
      [](const auto& of_type) -> std::string {
        using Type = std::decay_t<decltype(of_type)>;
        if constexpr (std::is_same_v<Type, PauseRun>) return of_type.on ? "pause" : "start";
        if constexpr (std::is_same_v<Type, StepOnce>) return "step 1";
        if constexpr (std::is_same_v<Type, SetRunSpeed>) {
          return "speed " + (of_type.speed == 0 ? "max" : std::to_string(of_type.speed));
        }
        if constexpr (std::is_same_v<Type, PlaceBody>) return "supervise " + changeText(of_type);
        return "";
      },
      action);
}

}  // namespace

void LivePageHub::begin(const std::string& id, const std::string& description) {
  const WebMessagePtr message = shared(description);
  {
    const std::lock_guard lock(mutex_);
    run_id_ = id;
    description_ = message;
    ++run_;
    history_.clear();
    first_item_ = history_.last();
    requests_.clear();
    has_requests_ = false;
  }
  options_.on_news();
}

void LivePageHub::describe(const std::string& description) {
  const WebMessagePtr message = shared(description);
  const std::lock_guard lock(mutex_);
  description_ = message;
}

void LivePageHub::add(std::vector<LiveItem> items) {
  bool is_news = false;
  {
    const std::lock_guard lock(mutex_);
    for (auto& item : items) history_.add(std::move(item));
    is_news = !pages_.empty();
  }
  if (is_news) options_.on_news();
}

void LivePageHub::setControl(const LiveControl& control) {
  // Called in each step: only this thread changes the control, so that comparing it needs no lock.
  if (control_count_ > 0 && control == control_) return;
  {
    const std::lock_guard lock(mutex_);
    control_ = control;
    ++control_count_;
  }
  options_.on_news();
}

void LivePageHub::setRecording(const std::vector<std::pair<std::string, std::string>>& blocks) {
  const std::lock_guard lock(mutex_);
  recorded_.clear();
  for (const auto& [id, text] : blocks) {
    for (std::size_t at = 0; at == 0 || at < text.size(); at += kPiece_bytes) {
      recorded_.push_back(
          shared(robosim::textOf({{"type", "block"}, {"id", id}, {"piece", text.substr(at, kPiece_bytes)}})));
    }
  }
  recorded_.push_back(shared(R"({"type":"recording"})"));
}

std::vector<LiveRequest> LivePageHub::takeRequests() {
  if (!has_requests_) return {};
  const std::lock_guard lock(mutex_);
  has_requests_ = false;
  return std::exchange(requests_, {});
}

void LivePageHub::answer(const LiveRequest& request, const std::string& fault) {
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(request.page);
    if (!page) return;
    replyFault(request.page, *page, request.id, fault);
  }
  options_.on_news();
}

void LivePageHub::pageOpened(PageId id, const std::string& peer) {
  const std::lock_guard lock(mutex_);
  Page& page = pages_[id];
  page.peer = peer;
  page.opened_at = options_.now();
}

void LivePageHub::pageClosed(PageId id) {
  const std::lock_guard lock(mutex_);
  pages_.erase(id);
}

void LivePageHub::pageInvalid(PageId id, const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (Page* const page = find(id)) disconnect(id, *page, why);
}

void LivePageHub::pageText(PageId id, std::string_view text) {
  const json message = json::parse(text, nullptr, false);
  const std::string type = message.is_object() ? textOf(message, "type") : "";
  const bool is_hello = type == "hello";
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(id);
    if (!page) return;
    if (!message.is_object()) return disconnect(id, *page, "a message that is no object of JSON");
    if (is_hello && page->is_admitted) return;
    if (!is_hello && !page->is_admitted) return disconnect(id, *page, "the first message must be a hello");
  }
  if (is_hello) {
    return hello(id, textOf(message, "token"), message.contains("token"), textOf(message, "run"),
                 countOf(message, "item"));
  }
  try {
    if (auto action = actionOf(type, message)) return request(id, countOf(message, "id"), std::move(*action));
    const std::lock_guard lock(mutex_);
    if (Page* const page = find(id)) disconnect(id, *page, "a message of an unknown type");
  } catch (const std::runtime_error& error) {
    const std::lock_guard lock(mutex_);
    if (Page* const page = find(id)) replyFault(id, *page, countOf(message, "id"), error.what());
  }
}

void LivePageHub::hello(PageId id, const std::string& token, bool has_token, const std::string& run,
                        std::uint64_t item) {
  std::string peer;
  {
    const std::lock_guard lock(mutex_);
    const Page* const page = find(id);
    if (!page) return;
    peer = page->peer;
  }
  const auto authenticated =
      options_.access.authenticate(has_token ? std::optional<std::string_view>(token) : std::nullopt, peer);
  const grpc::Status status =
      authenticated.status.ok() ? options_.access.check(authenticated.identity, Right::look) : authenticated.status;
  if (!status.ok()) {
    log_.write("refused live pages", "refused a live page at " + peer + ": " + status.error_message());
  }
  const std::lock_guard lock(mutex_);
  Page* const page = find(id);
  if (!page) return;
  if (!status.ok()) return refuse(id, *page, has_token ? status.error_message() : kTokenRequired);
  page->identity = authenticated.identity;
  page->is_admitted = true;
  const bool is_same = !run.empty() && run == run_id_ && item >= first_item_ && item <= history_.last();
  page->item = is_same ? item : first_item_;
  page->present = history_.last();
  if (is_same) page->run = run_;
}

void LivePageHub::request(PageId id, std::uint64_t number, LiveAction action) {
  const bool is_change = std::holds_alternative<PlaceBody>(action);
  Identity identity;
  std::string peer;
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(id);
    if (!page) return;
    std::string fault = whyNot(*page, is_change ? Right::supervise : Right::operate);
    if (fault.empty() && requests_.size() >= kMaxRequests) fault = "too many requests wait for the run; try again";
    if (!fault.empty()) return replyFault(id, *page, number, fault);
    identity = page->identity;
    peer = page->peer;
  }
  audit_.write(identity, peer, auditText(action));
  const std::lock_guard lock(mutex_);
  requests_.push_back({id, number, identity.name(), std::move(action)});
  has_requests_ = true;
}

/// Why a page may not use a right; empty if it may.
std::string LivePageHub::whyNot(const Page& page, Right right) const {
  const std::string& of_run = right == Right::supervise ? control_.why_not_supervised : control_.why_not_operated;
  if (!of_run.empty()) return of_run;
  const grpc::Status status = options_.access.check(page.identity, right);
  return status.ok() ? "" : status.error_message();
}

std::string LivePageHub::controlText(const Page& page) const {
  return robosim::textOf({{"type", "control"},
                          {"paused", control_.is_paused},
                          {"over", control_.is_over},
                          {"speed", control_.speed},
                          {"why_not_operated", whyNot(page, Right::operate)},
                          {"why_not_supervised", whyNot(page, Right::supervise)}});
}

bool LivePageHub::hasNews(const Page& page) const {
  if (!page.replies.empty()) return true;
  if (!page.is_admitted || page.is_leaving) return false;
  return page.recorded < recorded_.size() ||
         (description_ && (page.run != run_ || page.control != control_count_ || page.item < history_.last()));
}

WebMessagePtr LivePageHub::nextMessage(PageId id) {
  std::unique_lock lock(mutex_);
  const auto found = pages_.find(id);
  if (found == pages_.end() || !hasNews(found->second)) return nullptr;
  Page& page = found->second;
  if (!page.replies.empty()) {
    WebMessagePtr message = std::move(page.replies.front());
    page.replies.pop_front();
    return message;
  }
  if (page.recorded < recorded_.size()) return recorded_[page.recorded++];
  if (std::exchange(page.run, run_) != run_) {
    page.item = std::max(page.item, first_item_);
    page.present = history_.last();
    return description_;
  }
  if (std::exchange(page.control, control_count_) != control_count_) return shared(controlText(page));
  const std::uint64_t after = page.item;
  const auto part = history_.after(after, after >= page.present);
  if (!part) return nullptr;
  page.item = part->up_to;
  const bool is_present = page.item >= page.present;
  lock.unlock();
  return itemsMessage(after, *part, is_present);
}

/// Most pages are at the same item: they share the message.
WebMessagePtr LivePageHub::itemsMessage(std::uint64_t after, const LiveHistory::Part& part, bool is_present) {
  const SharedItems items{after, part.up_to, part.left_out, is_present};
  if (!shared_message_ || items != shared_items_) {
    shared_items_ = items;
    shared_message_ = shared("{\"type\":\"items\",\"last\":" + std::to_string(part.up_to) + ",\"left_out\":" +
                             std::to_string(part.left_out) + ",\"is_present\":" + (is_present ? "true" : "false") +
                             ",\"items\":[" + part.items() + "]}");
  }
  return shared_message_;
}

void LivePageHub::tick() {
  log_.reportSuppressed();
  audit_.reportSuppressed();
  const std::uint64_t version = options_.access.refresh();
  const std::lock_guard lock(mutex_);
  const bool are_new = std::exchange(access_version_, version) != version;
  const auto now = options_.now();
  for (auto& [id, page] : pages_) {
    if (page.is_leaving) continue;
    if (!page.is_admitted) {
      if (now - page.opened_at > kHelloWithin) disconnect(id, page, "no hello");
    } else if (are_new) {
      page.control = 0;  // its rights may be others
      const grpc::Status status = options_.access.check(page.identity, Right::look);
      if (status.ok()) continue;
      refuse(id, page, status.error_message());
    }
  }
}

std::vector<PageId> LivePageHub::waitingPages() const {
  const std::lock_guard lock(mutex_);
  std::vector<PageId> waiting;
  for (const auto& [id, page] : pages_) {
    if (hasNews(page)) waiting.push_back(id);
  }
  return waiting;
}

std::vector<std::pair<PageId, std::string>> LivePageHub::takeLeaving() {
  const std::lock_guard lock(mutex_);
  return std::exchange(leaving_, {});
}

/// A page that is not being disconnected; null for others.
LivePageHub::Page* LivePageHub::find(PageId id) {
  const auto found = pages_.find(id);
  return found == pages_.end() || found->second.is_leaving ? nullptr : &found->second;
}

void LivePageHub::reply(PageId id, Page& page, const std::string& text) {
  if (page.is_leaving) return;
  if (page.replies.size() >= kMaxReplies) return disconnect(id, page, "too many messages wait; read them");
  page.replies.push_back(shared(text));
}

/// The answer to a request. @param fault empty if it has an effect
void LivePageHub::replyFault(PageId id, Page& page, std::uint64_t request, const std::string& fault) {
  reply(id, page, robosim::textOf({{"type", "answer"}, {"id", request}, {"fault", fault}}));
}

void LivePageHub::refuse(PageId id, Page& page, const std::string& why) {
  reply(id, page, robosim::textOf({{"type", "refused"}, {"text", why}}));
  disconnect(id, page, "refused");
}

void LivePageHub::disconnect(PageId id, Page& page, const std::string& why) {
  if (std::exchange(page.is_leaving, true)) return;
  leaving_.emplace_back(id, why);
}

}  // namespace robosim
