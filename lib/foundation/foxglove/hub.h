#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/log_limiter.h"
#include "foxglove/client_message.h"
#include "foxglove/client_queue.h"
#include "foxglove/server_message.h"
#include "net/access.h"
#include "net/audit.h"
#include "web/message.h"

namespace robosim::foxglove {

/// A client, as handlers see it.
struct Client {
  PageId id = 0;
  std::string peer;  ///< address
  Identity identity;
};

/// A message that a client has published.
struct Publication {
  const ClientChannel& channel;
  std::string_view payload;
};

/// @name Requests of clients that the source of the channels handles between two steps
///@{
struct ParameterChange {
  Client client;
  std::vector<Parameter> parameters;
  std::optional<std::string> id;  ///< of the request, if it is to be answered
};
struct ServiceRequest {
  Client client;
  std::size_t service = 0;  ///< index
  std::uint32_t call = 0;
  std::string encoding, payload;
};
struct PlaybackRequest {
  Client client;
  PlaybackControl control;
};
using Request = std::variant<ParameterChange, ServiceRequest, PlaybackRequest>;
///@}

/// Handles what clients publish. Called in the web server's thread, without a lock of the hub; texts of refusals are
/// for the client.
class PublicationHandler {
 public:
  virtual ~PublicationHandler() = default;
  /// A client will publish on a topic. @return why not; empty if it may
  virtual std::string advertised(const Client& client, const ClientChannel& channel) = 0;
  /// @return why the message has no effect; empty if it has
  virtual std::string published(const Client& client, const Publication& publication) = 0;
  /// The client will publish no more, or has left.
  virtual void withdrawn(const Client& client, const ClientChannel& channel) = 0;
};

/// Channels of a server, its clients with their subscriptions, and what waits for them. One thread, the source, sets
/// the channels and sends messages; the web server's thread calls the functions of pages. The source never waits for a
/// client. Messages of clients are untrusted: no function throws because of them; an invalid one is answered by a
/// status, and a client that does not read its answers is disconnected.
///
/// The source sends in rounds: beginRound(), for each channel send() if wants(), endRound(). A round for those who are
/// new has the present state, which clients receive that have subscribed since; the next round for all includes them.
class Hub {
 public:
  static constexpr std::size_t kMaxClientChannels = 256;     ///< of a client
  static constexpr std::size_t kMaxRequests = 64;            ///< that wait for the source
  static constexpr std::size_t kMaxClientMessage = 1 << 20;  ///< bytes

  struct Options {
    Access access;                                                            ///< rights by token
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe
    std::function<void()> on_news = [] {};       ///< messages wait for clients; called in the source's thread
    PublicationHandler* publications = nullptr;  ///< must outlive this; null: clients may not publish
  };
  explicit Hub(Options options) : options_(std::move(options)) {}

  /// What a run offers to its clients.
  struct Offer {
    ServerInfo info;
    std::vector<Channel> channels;
    std::vector<Service> services;
  };
  enum class Audience { all, fresh };

  /// @name Of the source
  ///@{
  /// Replaces channels and services by those of another run.
  void offer(Offer offer);
  void beginRound();
  /// Whether a channel has a receiver in this round. @param channel index in Offer::channels
  bool wants(std::size_t channel, Audience audience) const {
    return channel < wanted_.size() && (audience == Audience::all ? wanted_[channel] != 0 : wanted_[channel] == kFresh);
  }
  /// Whether a channel has any subscription.
  bool isSubscribed(std::size_t channel) const;
  /// Whether any client has subscribed since the last round.
  bool hasFresh() const;
  /// @param latest_only whether the message makes those of the channel before it obsolete
  void send(std::size_t channel, Audience audience, std::uint64_t time_ns, const Payload& payload,
            bool latest_only = false);
  void sendTime(std::uint64_t time_ns);
  void endRound();

  /// Sets all parameters; sends those that have changed to the clients that watch them.
  void setParameters(const std::vector<Parameter>& parameters);
  std::vector<Request> takeRequests();
  void answer(const ParameterChange& change);
  void answer(const ServiceRequest& call, std::span<const std::uint8_t> response);
  void refuse(const ServiceRequest& call, const std::string& why);
  /// Informs all clients of the playback of a recording, those that come later, too.
  /// @param request whose effect it is; null: of none
  void setPlayback(const PlaybackState& state, const PlaybackRequest* request = nullptr);
  void sendStatus(PageId client, StatusLevel level, const std::string& text);
  void audit(const Client& client, const std::string& action) { audit_.write(client.identity, client.peer, action); }
  /// Whether a client's token has a right now. @param robot to drive; empty for none
  bool may(const Client& client, Right right, const std::string& robot = "") const;
  ///@}

  /// @name Of the web server, in its thread
  ///@{
  /// @param target of the request; its parameter `token` has the client's token
  void pageOpened(PageId page, const std::string& peer, const std::string& target);
  void pageClosed(PageId page);
  void pageText(PageId page, std::string_view text);
  void pageBinary(PageId page, std::string_view bytes);
  void pageInvalid(PageId page, const std::string& why);
  WebMessagePtr nextMessage(PageId page);
  /// Checks tokens. Call about 20 times per second.
  void tick();
  /// Pages for which messages wait.
  std::vector<PageId> waitingPages() const;
  /// Pages that are to be disconnected, with the reason; each once.
  std::vector<std::pair<PageId, std::string>> takeLeaving();
  ///@}

 private:
  static constexpr std::uint8_t kFresh = 2;

  struct Subscription {
    PageId client = 0;
    std::uint32_t id = 0;
    enum class State { fresh, in_round, settled } state = State::fresh;
  };
  struct AdvertisedChannel {
    ClientChannel channel;
    std::string refusal;  ///< of its last message, or of all; empty: none
    bool is_refused = false;
  };
  struct Page {
    Client client;
    bool is_leaving = false;
    bool has_lost = false;  ///< a message was dropped, and the client was informed
    ClientQueue queue;
    std::map<std::uint32_t, std::size_t> subscriptions;  ///< indices of channels
    std::map<std::uint32_t, AdvertisedChannel> advertised;
    bool watches_all = false;
    std::set<std::string> watched;  ///< parameters
  };

  /// @name Messages of a client; all with the mutex locked
  ///@{
  void handle(Page& page, const Subscribe& message);
  void handle(Page& page, const Unsubscribe& message);
  void handle(Page& page, const GetParameters& message);
  void handle(Page& page, const SetParameters& message);
  void handle(Page& page, const WatchParameters& message);
  void handle(Page& page, const ServiceCall& message);
  void handle(Page& page, const PlaybackControl& message);
  ///@}
  /// @name The same, which lock the mutex themselves: they call PublicationHandler
  ///@{
  void advertise(PageId id, const Advertise& message);
  void unadvertise(PageId id, const Unadvertise& message);
  void publish(PageId id, const PublishedMessage& message);
  ///@}
  void receive(PageId id, const ClientMessage& message);
  void request(Page& page, Request request);
  Page* find(PageId id);
  void unsubscribe(const Page& page, std::uint32_t id, std::size_t channel);
  void sendOffer(Page& page);
  void withdrawOffer();
  void control(Page& page, WebMessagePtr message);
  void control(Page& page, const std::string& text);
  void status(Page& page, StatusLevel level, const std::string& text);
  void disconnect(Page& page, const std::string& why);

  Options options_;
  LogLimiter log_{options_.log};
  AuditLog audit_{options_.log};
  std::vector<std::uint8_t> wanted_;  ///< by channel, in this round: 0, 1, or kFresh; of the source's thread
  mutable std::mutex mutex_;
  /// @name Guarded by the mutex
  ///@{
  Offer offer_;
  WebMessagePtr info_text_, channels_text_, services_text_;  ///< null: none
  std::uint32_t first_channel_ = 1, first_service_ = 1;      ///< ids; those of former runs are not used again
  std::vector<std::vector<Subscription>> subscriptions_;     ///< by channel
  bool has_fresh_ = false;
  std::map<PageId, Page> pages_;
  std::vector<Parameter> parameters_;
  std::optional<PlaybackState> playback_;
  std::vector<Request> requests_;
  std::vector<std::pair<PageId, std::string>> leaving_;
  std::uint64_t access_version_ = 0;
  ///@}
};

}  // namespace robosim::foxglove
