// Fuzzes the messages of Foxglove's clients: two clients send texts and binary messages to a Hub, whose channels they
// subscribe to and whose messages they do not read. Aborts when what waits for a client exceeds its limits.
#include <cstdlib>
#include <string_view>

#include "foxglove/hub.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace robosim;

struct Handler final : foxglove::PublicationHandler {
  std::string advertised(const foxglove::Client&, const foxglove::ClientChannel& channel) override {
    return channel.topic.size() < 8 ? "" : "refused";
  }
  std::string published(const foxglove::Client&, const foxglove::Publication& publication) override {
    return publication.payload.empty() ? "empty" : "";
  }
  void withdrawn(const foxglove::Client&, const foxglove::ClientChannel&) override {}
};

void send(foxglove::Hub& hub, const foxglove::Payload& payload) {
  for (const auto audience : {foxglove::Hub::Audience::fresh, foxglove::Hub::Audience::all}) {
    hub.beginRound();
    for (std::size_t channel = 0; channel < 2; ++channel) {
      if (hub.wants(channel, audience)) hub.send(channel, audience, 1, payload);
    }
    hub.sendTime(1);
    hub.endRound();
  }
}

}  // namespace

/// Messages are separated by a byte 0xff; the first byte of each selects client and kind.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Handler handler;
  foxglove::Hub::Options options;
  options.publications = &handler;
  foxglove::Hub hub(options);
  hub.offer({{"fuzz", {}, {"cdr"}, "1"}, {{"/a", "cdr", "A", "", "ros2msg"}, {"/b", "cdr", "B", "", "ros2msg"}}, {}});
  hub.setParameters({{"/a", 1, ""}});
  for (const PageId page : {1, 2}) hub.pageOpened(page, "192.0.2.7", "/");
  const auto payload = std::make_shared<const std::vector<std::uint8_t>>(1000);
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const auto end = rest.find('\xff');
    const std::string_view message = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (message.empty()) continue;
    const PageId page = message[0] & 1 ? 1 : 2;
    if (message[0] & 2) {
      hub.pageBinary(page, message.substr(1));
    } else {
      hub.pageText(page, message.substr(1));
    }
    send(hub, payload);
    if (message[0] & 4) hub.nextMessage(page);
    if (hub.takeRequests().size() > foxglove::Hub::kMaxRequests) std::abort();
  }
  for (const PageId page : {1, 2}) {
    std::size_t waiting = 0;
    while (hub.nextMessage(page)) ++waiting;
    if (waiting > foxglove::ClientQueue::kMaxControl + 1 + 2 * foxglove::ClientQueue::kMaxOfSubscription) std::abort();
    hub.pageClosed(page);
  }
  return 0;
}
