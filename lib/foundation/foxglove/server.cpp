#include "foxglove/server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <iterator>
#include <thread>
#include <utility>

#include "net/host_port.h"
#include "web/origin.h"
#include "web/server.h"

namespace robosim::foxglove {
namespace {

/// Foxglove in a browser, and its desktop application, whose pages are files.
constexpr std::array kApplications{"https://app.foxglove.dev", "https://studio.foxglove.dev", "file://"};

constexpr std::chrono::milliseconds kLastMessagesWithin{500};

}  // namespace

bool mayConnect(const std::string& origin, const std::string& host, const std::string& listen,
                const std::vector<std::string>& origins) {
  // The same server in the form of an origin, which isSameOrigin() also checks for a rebound name.
  if (!isSameOrigin("http://" + host, host, listen)) return false;
  if (origin.empty()) return true;
  return isSameOrigin(origin, host, listen) ||
         std::find(kApplications.begin(), kApplications.end(), origin) != kApplications.end() ||
         std::find(origins.begin(), origins.end(), origin) != origins.end();
}

struct Server::Impl {
  explicit Impl(const Options& options)
      : hub({.access = options.access,
             .log = options.log,
             .on_news = [this] { web.requestTick(); },
             .publications = options.publications}),
        web(webOptions(options), events()),
        thread([this] { web.serve([this] { return mustEnd(); }); }) {}
  ~Impl() {
    is_over = true;
    thread.join();
  }

  /// Clients receive what waits for them at the end, unless they are slow.
  bool mustEnd() {
    if (!is_over) return false;
    const auto now = std::chrono::steady_clock::now();
    if (!ends) ends = now + kLastMessagesWithin;
    return now >= *ends || hub.waitingPages().empty();
  }

  static WebServer::Options webOptions(const Options& options) {
    WebServer::Options web;
    web.listen = options.listen;
    web.tls = options.tls;
    web.protocols.assign(std::begin(kProtocols), std::end(kProtocols));
    web.max_message_bytes = Hub::kMaxClientMessage;
    web.may_open = [listen = options.listen, origins = options.origins](const std::string& origin,
                                                                        const std::string& host) {
      return mayConnect(origin, host, listen, origins);
    };
    web.log = options.log;
    web.option = "--foxglove";
    return web;
  }

  WebPageEvents events() {
    return {.opened =
                [this](PageId page, const WebOpening& opening) {
                  hub.pageOpened(page, opening.peer, opening.target);
                  act();
                },
            .received =
                [this](PageId page, std::string_view text) {
                  hub.pageText(page, text);
                  act();
                },
            .received_binary =
                [this](PageId page, std::string_view bytes) {
                  hub.pageBinary(page, bytes);
                  act();
                },
            .received_invalid =
                [this](PageId page, const std::string& why) {
                  hub.pageInvalid(page, why);
                  web.disconnect(page, why);
                },
            .closed = [this](PageId page) { hub.pageClosed(page); },
            .next = [this](PageId page) { return hub.nextMessage(page); },
            .tick =
                [this] {
                  hub.tick();
                  act();
                }};
  }
  void act() {
    for (const PageId page : hub.waitingPages()) web.wake(page);
    for (const auto& [page, why] : hub.takeLeaving()) web.disconnect(page, why);
  }

  Hub hub;
  WebServer web;
  std::atomic<bool> is_over{false};
  std::optional<std::chrono::steady_clock::time_point> ends;  ///< of the server's thread
  std::thread thread;
};

Server::Server(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
Server::~Server() = default;
int Server::port() const { return impl_->web.port(); }
Hub& Server::hub() { return impl_->hub; }

}  // namespace robosim::foxglove
