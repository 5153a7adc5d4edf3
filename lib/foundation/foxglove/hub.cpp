#include "foxglove/hub.h"

#include <algorithm>
#include <type_traits>

#include "foxglove/request_token.h"

namespace robosim::foxglove {
namespace {

constexpr const char* kSlow =
    "The connection is slower than the run: older messages are left out. Subscribe to fewer topics, or lower the speed";

WebMessagePtr shared(const std::string& text) { return std::make_shared<const WebMessage>(WebMessage::text(text)); }

WebMessagePtr binary(const std::string& bytes) {
  return std::make_shared<const WebMessage>(WebMessage::binary(bytes, {}));
}

/// Whether a client may connect at all: to watch, or to drive some robot.
bool mayJoin(const Access& access, const Identity& identity) {
  return access.check(identity, Right::look).ok() || access.check(identity, Right::drive).ok();
}

}  // namespace

bool Hub::may(const Client& client, Right right, const std::string& robot) const {
  const auto robots = robot.empty() ? std::span<const std::string>() : std::span(&robot, 1);
  return options_.access.check(client.identity, right, robots).ok();
}

void Hub::offer(Offer offer) {
  {
    const std::lock_guard lock(mutex_);
    withdrawOffer();
    first_channel_ += static_cast<std::uint32_t>(offer_.channels.size());
    first_service_ += static_cast<std::uint32_t>(offer_.services.size());
    offer_ = std::move(offer);
    subscriptions_.assign(offer_.channels.size(), {});
    has_fresh_ = false;
    info_text_ = shared(serverInfoText(offer_.info));
    channels_text_ = shared(advertiseText(offer_.channels, first_channel_));
    services_text_ = offer_.services.empty() ? nullptr : shared(advertiseServicesText(offer_.services, first_service_));
    requests_.clear();
    playback_.reset();
    for (auto& [id, page] : pages_) sendOffer(page);
  }
  wanted_.clear();
  options_.on_news();
}

/// Ends all subscriptions.
void Hub::withdrawOffer() {
  if (!info_text_) return;
  const auto channels = shared(unadvertiseText(first_channel_, offer_.channels.size()));
  const auto services =
      offer_.services.empty() ? nullptr : shared(unadvertiseServicesText(first_service_, offer_.services.size()));
  for (auto& [id, page] : pages_) {
    for (const auto& [subscription, channel] : page.subscriptions) page.queue.discard(subscription);
    page.subscriptions.clear();
    control(page, channels);
    if (services) control(page, services);
  }
}

void Hub::sendOffer(Page& page) {
  if (!info_text_ || page.is_leaving) return;
  control(page, info_text_);
  control(page, channels_text_);
  if (services_text_) control(page, services_text_);
  if (playback_) control(page, binary(playbackStateMessage(*playback_, "")));
}

bool Hub::isSubscribed(std::size_t channel) const {
  const std::lock_guard lock(mutex_);
  return channel < subscriptions_.size() && !subscriptions_[channel].empty();
}

bool Hub::hasFresh() const {
  const std::lock_guard lock(mutex_);
  return has_fresh_;
}

void Hub::beginRound() {
  const std::lock_guard lock(mutex_);
  wanted_.assign(subscriptions_.size(), 0);
  for (std::size_t i = 0; i < subscriptions_.size(); ++i) {
    for (auto& subscription : subscriptions_[i]) {
      if (subscription.state == Subscription::State::fresh) subscription.state = Subscription::State::in_round;
      const bool is_new = subscription.state == Subscription::State::in_round;
      wanted_[i] = std::max(wanted_[i], is_new ? kFresh : std::uint8_t{1});
    }
  }
  has_fresh_ = false;
}

void Hub::send(std::size_t channel, Audience audience, std::uint64_t time_ns, const Payload& payload,
               bool latest_only) {
  const std::lock_guard lock(mutex_);
  for (const auto& subscription : subscriptions_[channel]) {
    using State = Subscription::State;
    if (subscription.state == State::fresh) continue;  // of the next round
    if (audience == Audience::fresh && subscription.state != State::in_round) continue;
    Page& page = pages_.at(subscription.client);
    if (page.is_leaving) continue;
    const std::size_t dropped = page.queue.addData(subscription.id, time_ns, payload, latest_only);
    if (dropped > 0 && !std::exchange(page.has_lost, true)) status(page, StatusLevel::warning, kSlow);
  }
}

void Hub::sendTime(std::uint64_t time_ns) {
  const std::lock_guard lock(mutex_);
  for (auto& [id, page] : pages_) {
    if (!page.is_leaving) page.queue.addTime(time_ns);
  }
}

void Hub::endRound() {
  bool is_news = false;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (wanted_[i] != kFresh) continue;
      for (auto& subscription : subscriptions_[i]) {
        using State = Subscription::State;
        if (subscription.state == State::in_round) subscription.state = State::settled;
      }
    }
    is_news = !pages_.empty();
  }
  if (is_news) options_.on_news();
}

void Hub::setParameters(const std::vector<Parameter>& parameters) {
  {
    const std::lock_guard lock(mutex_);
    if (parameters == parameters_) return;
    std::map<std::string, const Parameter*> former;
    for (const auto& parameter : parameters_) former[parameter.name] = &parameter;
    std::vector<Parameter> changed;
    for (const auto& parameter : parameters) {
      const auto found = former.find(parameter.name);
      if (found == former.end() || *found->second != parameter) changed.push_back(parameter);
      if (found != former.end()) former.erase(found);
    }
    for (const auto& [name, parameter] : former) changed.push_back({name, {}, {}});  // it is no longer there
    parameters_ = parameters;
    for (auto& [id, page] : pages_) {
      std::vector<Parameter> watched;
      std::copy_if(changed.begin(), changed.end(), std::back_inserter(watched), [&page = page](const auto& parameter) {
        return page.watches_all || page.watched.count(parameter.name) > 0;
      });
      if (!watched.empty()) control(page, parameterValuesText(watched, std::nullopt));
    }
  }
  options_.on_news();
}

void Hub::setPlayback(const PlaybackState& state, const PlaybackRequest* request) {
  {
    const std::lock_guard lock(mutex_);
    playback_ = state;
    playback_->did_seek = false;
    const WebMessagePtr message = binary(playbackStateMessage(state, ""));
    for (auto& [id, page] : pages_) {
      const bool is_answer = request && request->client.id == id;
      control(page, is_answer ? binary(playbackStateMessage(state, request->control.id)) : message);
    }
  }
  options_.on_news();
}

std::vector<Request> Hub::takeRequests() {
  const std::lock_guard lock(mutex_);
  return std::exchange(requests_, {});
}

void Hub::answer(const ParameterChange& change) {
  if (!change.id) return;
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(change.client.id);
    if (!page) return;
    std::vector<Parameter> now;
    for (const auto& parameter : parameters_) {
      const auto is_same = [&](const Parameter& changed) { return changed.name == parameter.name; };
      if (std::any_of(change.parameters.begin(), change.parameters.end(), is_same)) now.push_back(parameter);
    }
    control(*page, parameterValuesText(now, change.id));
  }
  options_.on_news();
}

void Hub::answer(const ServiceRequest& call, std::span<const std::uint8_t> response) {
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(call.client.id);
    if (!page) return;
    const auto service = static_cast<std::uint32_t>(first_service_ + call.service);
    const std::string_view payload(reinterpret_cast<const char*>(response.data()), response.size());
    control(*page, std::make_shared<const WebMessage>(
                       WebMessage::binary(serviceResponseHead(service, call.call, call.encoding), payload)));
  }
  options_.on_news();
}

void Hub::refuse(const ServiceRequest& call, const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(call.client.id);
    if (!page) return;
    control(*page, serviceFailureText(static_cast<std::uint32_t>(first_service_ + call.service), call.call, why));
  }
  options_.on_news();
}

void Hub::sendStatus(PageId client, StatusLevel level, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    if (Page* const page = find(client)) status(*page, level, text);
  }
  options_.on_news();
}

void Hub::pageOpened(PageId id, const std::string& peer, const std::string& target) {
  const auto authenticated = options_.access.authenticate(tokenOf(target), peer);
  const std::lock_guard lock(mutex_);
  Page& page = pages_[id];
  page.client = {id, peer, authenticated.identity};
  std::string why;
  if (!authenticated.status.ok()) {
    why = authenticated.status.error_message() + "; add ?token=TOKEN to the address of the connection";
  } else if (!mayJoin(options_.access, authenticated.identity)) {
    why = "the token permits neither watching nor driving; use another";
  }
  if (!why.empty()) {
    log_.write("refused Foxglove clients", "refused a Foxglove client at " + peer + ": " + why);
    status(page, StatusLevel::error, why);
    disconnect(page, why);
    return;
  }
  sendOffer(page);
}

void Hub::pageClosed(PageId id) {
  std::optional<Page> closed;
  {
    const std::lock_guard lock(mutex_);
    const auto found = pages_.find(id);
    if (found == pages_.end()) return;
    for (const auto& [subscription, channel] : found->second.subscriptions) {
      unsubscribe(found->second, subscription, channel);
    }
    closed = std::move(found->second);
    pages_.erase(found);
  }
  if (!options_.publications) return;
  for (const auto& [channel_id, advertised] : closed->advertised) {
    if (!advertised.is_refused) options_.publications->withdrawn(closed->client, advertised.channel);
  }
}

void Hub::pageText(PageId page, std::string_view text) {
  try {
    receive(page, parseText(text));
  } catch (const ClientMessageError& error) {
    sendStatus(page, StatusLevel::error, error.what());
  }
}

void Hub::pageBinary(PageId page, std::string_view bytes) {
  try {
    receive(page, parseBinary(bytes));
  } catch (const ClientMessageError& error) {
    sendStatus(page, StatusLevel::error, error.what());
  }
}

void Hub::pageInvalid(PageId id, const std::string& why) {
  const std::lock_guard lock(mutex_);
  Page* const page = find(id);
  if (!page) return;
  log_.write("invalid messages of Foxglove clients",
             "disconnected a Foxglove client at " + page->client.peer + ": " + why);
  disconnect(*page, why);
}

void Hub::receive(PageId id, const ClientMessage& message) {
  std::visit(
      [&](const auto& of_type) {
        using Type = std::decay_t<decltype(of_type)>;
        if constexpr (std::is_same_v<Type, Advertise>) {
          advertise(id, of_type);
        } else if constexpr (std::is_same_v<Type, Unadvertise>) {
          unadvertise(id, of_type);
        } else if constexpr (std::is_same_v<Type, PublishedMessage>) {
          publish(id, of_type);
        } else {
          const std::lock_guard lock(mutex_);
          if (Page* const page = find(id)) handle(*page, of_type);
        }
      },
      message);
}

void Hub::handle(Page& page, const Subscribe& message) {
  if (!may(page.client, Right::look)) {
    status(page, StatusLevel::error, "subscribe: the token permits driving, not watching, which shows true poses");
    return;
  }
  for (const auto& [id, channel_id] : message.subscriptions) {
    const std::string what = "subscribe: channel " + std::to_string(channel_id);
    const std::size_t channel = channel_id - first_channel_;  // a smaller id becomes a large number
    if (channel_id < first_channel_ || channel >= offer_.channels.size()) {
      status(page, StatusLevel::error, what + " does not exist");
    } else if (page.subscriptions.count(id) > 0) {
      status(page, StatusLevel::error, "subscribe: the subscription " + std::to_string(id) + " exists already");
    } else if (std::any_of(page.subscriptions.begin(), page.subscriptions.end(),
                           [&](const auto& known) { return known.second == channel; })) {
      status(page, StatusLevel::warning, what + " has a subscription already");
    } else {
      page.subscriptions[id] = channel;
      subscriptions_[channel].push_back({page.client.id, id});
      has_fresh_ = true;
    }
  }
}

void Hub::handle(Page& page, const Unsubscribe& message) {
  for (const auto id : message.subscriptions) {
    const auto found = page.subscriptions.find(id);
    if (found == page.subscriptions.end()) {
      status(page, StatusLevel::warning, "unsubscribe: there is no subscription " + std::to_string(id));
      continue;
    }
    unsubscribe(page, id, found->second);
    page.queue.discard(id);
    page.subscriptions.erase(found);
  }
}

void Hub::unsubscribe(const Page& page, std::uint32_t id, std::size_t channel) {
  std::erase_if(subscriptions_[channel], [&](const Subscription& subscription) {
    return subscription.client == page.client.id && subscription.id == id;
  });
}

void Hub::handle(Page& page, const GetParameters& message) {
  if (!may(page.client, Right::look)) {
    status(page, StatusLevel::error, "getParameters: the token permits driving, not watching");
    return;
  }
  const std::set<std::string> names(message.names.begin(), message.names.end());
  std::vector<Parameter> values;
  std::copy_if(parameters_.begin(), parameters_.end(), std::back_inserter(values),
               [&](const Parameter& parameter) { return names.empty() || names.count(parameter.name) > 0; });
  control(page, parameterValuesText(values, message.id));
}

void Hub::handle(Page& page, const SetParameters& message) {
  request(page, ParameterChange{page.client, message.parameters, message.id});
}

void Hub::handle(Page& page, const WatchParameters& message) {
  if (message.on && !may(page.client, Right::look)) {
    status(page, StatusLevel::error, "subscribeParameterUpdates: the token permits driving, not watching");
    return;
  }
  if (message.names.empty()) {
    page.watches_all = message.on;
    if (!message.on) page.watched.clear();
  }
  for (const auto& name : message.names) {
    const bool is_known = std::any_of(parameters_.begin(), parameters_.end(),
                                      [&](const Parameter& parameter) { return parameter.name == name; });
    if (!message.on) {
      page.watched.erase(name);
    } else if (is_known) {
      page.watched.insert(name);
    } else {
      status(page, StatusLevel::warning, "subscribeParameterUpdates: there is no parameter '" + name + "'");
    }
  }
}

void Hub::handle(Page& page, const ServiceCall& message) {
  const std::size_t service = message.service - first_service_;
  if (message.service < first_service_ || service >= offer_.services.size()) {
    control(page, serviceFailureText(message.service, message.call, "there is no such service"));
    return;
  }
  request(page, ServiceRequest{page.client, service, message.call, message.encoding, std::string(message.payload)});
}

void Hub::handle(Page& page, const PlaybackControl& message) {
  if (!offer_.info.duration_ns) {
    status(page, StatusLevel::error, "this server plays no recording");
    return;
  }
  request(page, PlaybackRequest{page.client, message});
}

void Hub::request(Page& page, Request request) {
  if (requests_.size() >= kMaxRequests) {
    status(page, StatusLevel::error, "too many requests wait for the run; send this one again later");
    return;
  }
  requests_.push_back(std::move(request));
}

void Hub::advertise(PageId id, const Advertise& message) {
  for (const auto& channel : message.channels) {
    Client client;
    {
      const std::lock_guard lock(mutex_);
      Page* const page = find(id);
      if (!page) return;
      const bool is_known = page->advertised.count(channel.id) > 0;
      if (is_known || page->advertised.size() >= kMaxClientChannels) {
        status(*page, StatusLevel::error,
               is_known ? "advertise: the channel " + std::to_string(channel.id) + " exists already"
                        : "advertise: a client has at most " + std::to_string(kMaxClientChannels) + " channels");
        continue;
      }
      client = page->client;
    }
    // Only this thread adds and removes pages and their channels.
    const std::string why =
        options_.publications ? options_.publications->advertised(client, channel) : "this server accepts no messages";
    const std::lock_guard lock(mutex_);
    Page& page = pages_.at(id);
    page.advertised[channel.id] = {channel, why, !why.empty()};
    if (!why.empty()) status(page, StatusLevel::error, channel.topic + ": " + why);
  }
}

void Hub::unadvertise(PageId id, const Unadvertise& message) {
  for (const auto channel_id : message.channels) {
    AdvertisedChannel removed;
    Client client;
    {
      const std::lock_guard lock(mutex_);
      Page* const page = find(id);
      if (!page) return;
      const auto found = page->advertised.find(channel_id);
      if (found == page->advertised.end()) {
        status(*page, StatusLevel::warning, "unadvertise: there is no channel " + std::to_string(channel_id));
        continue;
      }
      client = page->client;
      removed = std::move(found->second);
      page->advertised.erase(found);
    }
    if (!removed.is_refused) options_.publications->withdrawn(client, removed.channel);
  }
}

void Hub::publish(PageId id, const PublishedMessage& message) {
  AdvertisedChannel* advertised = nullptr;
  Client client;
  {
    const std::lock_guard lock(mutex_);
    Page* const page = find(id);
    if (!page) return;
    const auto found = page->advertised.find(message.channel);
    if (found == page->advertised.end()) {
      status(*page, StatusLevel::error,
             "a message of the channel " + std::to_string(message.channel) + ", which is not advertised");
      return;
    }
    if (found->second.is_refused) return;  // which the client was informed of
    advertised = &found->second;
    client = page->client;
  }
  // Only this thread changes the channels of pages.
  const std::string why = options_.publications->published(client, {advertised->channel, message.payload});
  if (std::exchange(advertised->refusal, why) == why || why.empty()) return;  // once, until a message has an effect
  const std::lock_guard lock(mutex_);
  status(pages_.at(id), StatusLevel::error, advertised->channel.topic + ": " + why);
}

WebMessagePtr Hub::nextMessage(PageId id) {
  std::optional<ClientQueue::Next> next;
  {
    const std::lock_guard lock(mutex_);
    const auto found = pages_.find(id);
    if (found == pages_.end()) return nullptr;
    next = found->second.queue.take();
  }
  return next ? next->message() : nullptr;  // copied without the lock
}

void Hub::tick() {
  log_.reportSuppressed();
  audit_.reportSuppressed();
  const std::uint64_t version = options_.access.refresh();
  const std::lock_guard lock(mutex_);
  if (std::exchange(access_version_, version) == version) return;
  for (auto& [id, page] : pages_) {
    if (page.is_leaving) continue;
    if (!mayJoin(options_.access, page.client.identity)) {
      status(page, StatusLevel::error, "the token is no longer valid");
      disconnect(page, "the token is no longer valid");
    } else if (!may(page.client, Right::look)) {
      for (const auto& [subscription, channel] : page.subscriptions) {
        unsubscribe(page, subscription, channel);
        page.queue.discard(subscription);
      }
      page.subscriptions.clear();
      page.watches_all = false;
      page.watched.clear();
    }
  }
}

std::vector<PageId> Hub::waitingPages() const {
  const std::lock_guard lock(mutex_);
  std::vector<PageId> waiting;
  for (const auto& [id, page] : pages_) {
    if (!page.queue.isEmpty()) waiting.push_back(id);
  }
  return waiting;
}

std::vector<std::pair<PageId, std::string>> Hub::takeLeaving() {
  const std::lock_guard lock(mutex_);
  return std::exchange(leaving_, {});
}

/// A page that is not being disconnected; null for others.
Hub::Page* Hub::find(PageId id) {
  const auto found = pages_.find(id);
  return found == pages_.end() || found->second.is_leaving ? nullptr : &found->second;
}

void Hub::control(Page& page, WebMessagePtr message) {
  if (page.is_leaving || page.queue.addControl(std::move(message))) return;
  log_.write("Foxglove clients that do not read",
             "disconnected a Foxglove client at " + page.client.peer + ": it does not read its messages");
  disconnect(page, "too many messages wait; read them");
}

void Hub::control(Page& page, const std::string& text) { control(page, shared(text)); }

void Hub::status(Page& page, StatusLevel level, const std::string& text) { control(page, statusText(level, text)); }

void Hub::disconnect(Page& page, const std::string& why) {
  if (std::exchange(page.is_leaving, true)) return;
  leaving_.emplace_back(page.client.id, why);
}

}  // namespace robosim::foxglove
