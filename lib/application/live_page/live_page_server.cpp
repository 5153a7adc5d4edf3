#include "live_page/live_page_server.h"

#include <atomic>
#include <chrono>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "net/host_port.h"
#include "run_page/page_document.h"
#include "web/server.h"

namespace robosim {
namespace {

constexpr std::chrono::milliseconds kLastMessagesWithin{500};

std::span<const unsigned char> bytesOf(std::string_view text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

}  // namespace

struct LivePageServer::Impl {
  explicit Impl(const Options& options)
      : files(servedRunPage("RoboSim")),
        hub({.access = options.access, .log = options.log, .on_news = [this] { web.requestTick(); }}),
        web(webOptions(options), events()),
        thread([this] { web.serve([this] { return mustEnd(); }); }) {}
  ~Impl() {
    is_over = true;
    thread.join();
  }

  bool mustEnd() {
    if (!is_over) return false;
    const auto now = std::chrono::steady_clock::now();
    if (!ends) ends = now + kLastMessagesWithin;
    return now >= *ends || (hub.waitingPages().empty() && !web.isSending());
  }

  WebServer::Options webOptions(const Options& options) const {
    WebServer::Options served;
    served.listen = options.listen;
    served.option = "--web";
    served.tls = options.tls;
    for (const auto& file : files) served.files.push_back({file.path, file.type, bytesOf(file.bytes)});
    served.protocols = {LivePageHub::kProtocol};
    served.max_message_bytes = LivePageHub::kMaxMessage_bytes;
    served.log = options.log;
    return served;
  }

  WebPageEvents events() {
    return {.opened =
                [this](PageId page, const WebOpening& opening) {
                  hub.pageOpened(page, opening.peer);
                  act();
                },
            .received =
                [this](PageId page, std::string_view text) {
                  hub.pageText(page, text);
                  act();
                },
            .received_invalid =
                [this](PageId page, const std::string& why) {
                  hub.pageInvalid(page, why);
                  act();
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

  std::vector<ServedPageFile> files;
  LivePageHub hub;
  WebServer web;
  std::atomic<bool> is_over{false};
  std::optional<std::chrono::steady_clock::time_point> ends;  ///< of the server's thread
  std::thread thread;
};

LivePageServer::LivePageServer(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
LivePageServer::~LivePageServer() = default;
int LivePageServer::port() const { return impl_->web.port(); }
LivePageHub& LivePageServer::hub() { return impl_->hub; }

std::string livePageAddress(const std::string& address) {
  const bool is_host =
      address.find(':') == std::string::npos && address.find_first_not_of("0123456789") != std::string::npos;
  return hostAndPort(is_host || address.ends_with(']') ? address + ":8081" : address);
}

std::string livePageLine(const LivePageServer::Options& options, int port) {
  return "page of the run: " + std::string(options.tls ? "https" : "http") + "://" + withPort(options.listen, port) +
         "/";
}

}  // namespace robosim
