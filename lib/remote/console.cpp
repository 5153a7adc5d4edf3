#include "remote/console.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <utility>

#include "remote/page.h"
#include "remote/page_json.h"
#include "remote/page_message.h"
#include "remote/team_notes.h"
#include "remote/web_server.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;
using Clock = RemoteControl::Clock;
using Message = std::shared_ptr<const WebMessage>;

/// Sent and not yet shown: enough to keep a page busy over the time that a message is on its way.
constexpr std::uint64_t kMostUnderway = 3;
/// A page that shows nothing for so long is hung up on.
constexpr auto kPatience = 6s;
constexpr auto kHelloWithin = 10s;
/// More often a page is told of steps only if there is a new picture.
constexpr auto kUpdatePause = 33ms;
constexpr auto kPosesPause = 100ms;
/// More orders than one in this time are cut to the newest; the robot cuts them to one a step anyway.
constexpr auto kSteerPause = 10ms;
/// Lines that a page which reads slowly may still see.
constexpr std::size_t kMostMail = 50;

Message textMessage(const std::string& json) { return std::make_shared<const WebMessage>(WebMessage::text(json)); }

/// One page.
struct Guest {
  std::string peer, name;
  std::optional<std::string> token;
  Clock::time_point came;
  bool is_in = false;  ///< its hello was good
  bool wants_sensors = true, wants_map = false;
  std::deque<Message> mail;
  /// @name What it has been told
  ///@{
  std::uint64_t team = 0, robot = 0, map = 0;  ///< versions
  std::shared_ptr<const RobotUpdate> update;
  std::shared_ptr<const RobotPicture> picture;
  std::shared_ptr<const MapView> poses;
  Clock::time_point update_sent, poses_sent;
  ///@}
  std::uint64_t sent = 0, shown = 0;  ///< updates
  Clock::time_point shown_at;         ///< or when there was nothing to show
};

/// Something that pages are told again when it has changed.
struct Versioned {
  std::uint64_t version = 0;
  std::string json;
  Message message;

  bool update(const std::string& now) {
    if (now == json && message) return false;
    json = now;
    message = textMessage(now);
    ++version;
    return true;
  }
};

/// An update made into a message once for all pages that want it in the same way.
class UpdateMessages {
 public:
  Message of(const RobotNews& news, bool with_picture, bool with_sensors) {
    if (news.update != update_ || news.picture != picture_) {
      made_ = {};
      update_ = news.update;
      picture_ = news.picture;
    }
    Message& made = made_[(with_picture ? 1 : 0) + (with_sensors ? 2 : 0)];
    if (!made) made = make(news, with_picture, with_sensors);
    return made;
  }

 private:
  /// The length of the JSON text (4 bytes, the lowest first), the text, and the JPEG file.
  static Message make(const RobotNews& news, bool with_picture, bool with_sensors) {
    const std::string json =
        updateJson(*news.info, *news.update, with_picture ? news.picture.get() : nullptr, with_sensors);
    std::string head;
    for (int i = 0; i < 4; ++i) head += static_cast<char>(json.size() >> (8 * i) & 0xff);
    return std::make_shared<const WebMessage>(
        WebMessage::binary(head + json, with_picture ? std::string_view(news.picture->jpeg) : std::string_view()));
  }

  std::shared_ptr<const RobotUpdate> update_;
  std::shared_ptr<const RobotPicture> picture_;
  std::array<Message, 4> made_;
};

}  // namespace

struct Console::Impl final : public WebGuests {
  Impl(const Options& the_options, const std::vector<RobotAddress>& team);

  /// @name What the server tells
  ///@{
  void came(GuestId guest, const std::string& peer) override;
  void said(GuestId guest, std::string_view text) override;
  void left(GuestId guest) override;
  Message next(GuestId guest) override;
  void tick() override;
  ///@}

  void hello(GuestId id, Guest& guest, const PageMessage& message);
  void obey(GuestId id, Guest& guest, const PageMessage& message);
  void take(GuestId id, Guest& guest);
  void release(GuestId id, const std::string& why);
  void drive(const PageMessage& message);
  void steer(const RemoteOrder& order);
  void sendSteering();
  void noteNews(const std::vector<RemoteControl::Robot>& robots);
  void noteAnswers();
  void watchMap();
  bool isUpdateDue(const Guest& guest) const;
  bool mayDrive(const Guest& guest, const std::string& robot) const;
  void tellAll(const std::string& json);
  void wakeAll(bool is_news);
  Clock::time_point now() const { return options.control.now(); }

  Options options;
  WebServer server;
  RemoteControl control;
  std::map<GuestId, Guest> guests;
  Wheel wheel;
  Versioned team, robot, map_world;
  RobotNews primary;  ///< as of the last tick
  TeamNotes notes;
  std::array<std::shared_ptr<const RobotAnswer>, 3> answered;  ///< what has been told
  UpdateMessages updates;
  std::shared_ptr<const MapView> map_view;
  std::optional<RemoteOrder> steering;  ///< waits for its time
  Clock::time_point steered;
  bool is_map_wanted = false;
};

namespace {

WebServer::Options serverOptions(const Console::Options& options) {
  WebServer::Options server;
  server.listen = options.listen;
  server.tls = options.tls;
  server.files = pageFiles();
  server.protocol = kPageProtocol;
  server.log = options.log;
  return server;
}

RemoteControl::Options controlOptions(const Console::Options& options, WebServer& server) {
  RemoteControl::Options control = options.control;
  control.ring = [&server] { server.ring(); };
  return control;
}

}  // namespace

Console::Impl::Impl(const Options& the_options, const std::vector<RobotAddress>& team_list)
    : options(the_options),
      server(serverOptions(options), *this),
      control(team_list, controlOptions(options, server)) {}

void Console::Impl::came(GuestId id, const std::string& peer) {
  Guest& guest = guests[id];
  guest.peer = peer;
  guest.came = guest.shown_at = now();
}

void Console::Impl::left(GuestId id) {
  const auto found = guests.find(id);
  if (found == guests.end()) return;
  if (found->second.is_in) options.log(found->second.name + " has left");
  release(id, found->second.name + "'s page has gone");
  guests.erase(id);
}

void Console::Impl::said(GuestId id, std::string_view text) {
  Guest& guest = guests.at(id);
  const PageMessage message = PageMessage::parse(text);
  if (message.type == PageMessage::Type::hello) {
    hello(id, guest, message);
  } else if (guest.is_in) {
    obey(id, guest, message);
  } else {
    throw WireError("the first message of a page must be its hello");
  }
}

void Console::Impl::hello(GuestId id, Guest& guest, const PageMessage& message) {
  if (!message.token.empty()) guest.token = message.token;
  const bool may_look =
      options.access.check(guest.token, Right::look).ok() || options.access.check(guest.token, Right::drive).ok();
  if (!may_look) {
    const char* why = guest.token ? "That token is not known here." : "This console asks for a token.";
    guest.mail.push_back(textMessage(R"({"type":"refused","text":")" + std::string(why) + "\"}"));
    options.log(std::string("refused a page at ") + guest.peer + (guest.token ? ": unknown token" : ": no token"));
    server.hangUp(id, why);
    return;
  }
  guest.name = message.name.empty() ? "Guest " + std::to_string(id) : message.name;
  if (!std::exchange(guest.is_in, true)) options.log(guest.name + " at " + guest.peer + " has come");
  guest.mail.push_back(textMessage(R"({"type":"welcome","you":)" + std::to_string(id) + "}"));
  server.wake(id);
}

bool Console::Impl::mayDrive(const Guest& guest, const std::string& robot_name) const {
  return options.access.check(guest.token, Right::drive, std::span(&robot_name, 1)).ok();
}

void Console::Impl::obey(GuestId id, Guest& guest, const PageMessage& message) {
  using Type = PageMessage::Type;
  const bool has_wheel = wheel.holder == id;
  switch (message.type) {
    case Type::hello:
      break;
    case Type::ack:
      if (message.number > guest.sent) throw WireError("an ack for an update that was not sent");
      guest.shown = message.number;
      guest.shown_at = now();
      server.wake(id);
      break;
    case Type::live:
      guest.wants_sensors = message.on;
      break;
    case Type::map:
      guest.wants_map = message.on;
      guest.map = 0;
      watchMap();
      break;
    case Type::take:
      take(id, guest);
      break;
    case Type::release:
      release(id, guest.name + " has let go of the wheel");
      break;
    case Type::drive:
      if (has_wheel) drive(message);
      break;
    case Type::steer:
      // Anybody may ask for a reading; the answer goes to everyone.
      if (message.order >= RemoteType::req_heat && message.order <= RemoteType::req_sonar) {
        control.send({.type = message.order});
      } else if (has_wheel) {
        steer({.type = message.order, .why = message.why.empty() ? "" : guest.name + "'s page " + message.why});
      }
      break;
    case Type::autonomous:
      if (has_wheel) control.setAutonomous(message.on);
      break;
    case Type::switching: {
      if (!has_wheel) break;
      steering.reset();
      const bool is_allowed = message.robot.empty() || mayDrive(guest, message.robot);
      const bool done =
          is_allowed && (message.robot.empty() ? control.switchPrimary() : control.switchTo(message.robot));
      if (!done) {
        guest.mail.push_back(
            textMessage(noteJson(!is_allowed             ? "Your token is not for " + message.robot + "."
                                 : message.robot.empty() ? "There is no other robot that could be driven now."
                                                         : message.robot + " cannot be driven now.",
                                 true)));
      }
      tick();
      break;
    }
  }
}

void Console::Impl::take(GuestId id, Guest& guest) {
  if (wheel.holder != 0 && wheel.holder != id) {
    guest.mail.push_back(textMessage(noteJson(wheel.name + " drives; you may watch.", false)));
    server.wake(id);
    return;
  }
  if (!mayDrive(guest, control.primary().name)) {
    guest.mail.push_back(textMessage(noteJson("Your token lets you look on, not drive.", false)));
    server.wake(id);
    return;
  }
  if (wheel.holder != id) options.log(guest.name + " has the wheel");
  wheel.holder = id;
  wheel.name = guest.name;
  control.setDriver(guest.name);
  tick();
}

/// Does nothing for a page that does not have the wheel.
void Console::Impl::release(GuestId id, const std::string& why) {
  if (wheel.holder != id) return;
  wheel.holder = 0;
  wheel.name.clear();
  steering.reset();
  control.send({.type = RemoteType::stop, .why = why.substr(0, kMaxWhyBytes)});
  tick();
}

void Console::Impl::drive(const PageMessage& message) {
  if (!primary.info) return;
  const MotionLimits& limits = primary.info->limits;
  RemoteOrder order{.type = RemoteType::drive};
  if (message.speed) order.speed_mps = *message.speed * limits.speed_max_mps;
  if (message.turn) order.turn_radps = *message.turn * limits.turn_max_radps;
  if (message.pan_rad) order.laser_pan_rad = static_cast<float>(*message.pan_rad);
  steer(order);
}

void Console::Impl::steer(const RemoteOrder& order) {
  if (order.type == RemoteType::alive || order.type == RemoteType::check_win) {
    control.send(order);
    return;
  }
  steering = order;
  sendSteering();
}

void Console::Impl::sendSteering() {
  if (!steering || now() - steered < kSteerPause) return;
  control.send(*std::exchange(steering, std::nullopt));
  steered = now();
}

void Console::Impl::tick() {
  control.tick();
  sendSteering();
  const auto robots = control.robots();
  noteNews(robots);
  const auto update_before = primary.update;
  const auto info_before = primary.info;
  primary = robots.front().news;
  bool is_news = primary.update != update_before;
  if (primary.info && primary.info != info_before) is_news |= robot.update(robotJson(*primary.info, primary.period_s));
  noteAnswers();
  wheel.guests = static_cast<std::size_t>(
      std::count_if(guests.begin(), guests.end(), [](const auto& guest) { return guest.second.is_in; }));
  is_news |= team.update(teamJson(robots, wheel));
  if (options.map && is_map_wanted) {
    const auto view = options.map->newest();
    is_news |= view != map_view;
    if (!map_view || view->world != map_view->world || view->problem != map_view->problem) {
      map_view = view;
      map_world.update(mapJson(*view));
    }
    map_view = view;
  }
  for (const auto& [id, guest] : guests) {
    const bool is_silent = !guest.is_in && now() - guest.came > kHelloWithin;
    const bool is_stuck = guest.sent > guest.shown && now() - guest.shown_at > kPatience;
    if (is_silent) server.hangUp(id, "no hello within 10 s; the first message must be one, at once");
    if (is_stuck) server.hangUp(id, "nothing shown for 6 s of what was sent");
  }
  wakeAll(is_news);
}

/// Tells people what has happened to the robots since the last time. Why robots stop, those log themselves; who has
/// won, the page's banner says.
void Console::Impl::noteNews(const std::vector<RemoteControl::Robot>& robots) {
  using Kind = TeamNotes::Kind;
  for (const auto& [kind, text] : notes.news(robots)) {
    if (kind != Kind::won) tellAll(noteJson(text, kind != Kind::up));
    if (kind != Kind::stopped && kind != Kind::too_far) options.log(text);
  }
}

void Console::Impl::noteAnswers() {
  constexpr std::array sensors{"heat", "laser", "sonar"};
  static_assert(sensors.size() == std::tuple_size_v<decltype(RobotNews::answers)>);
  const RobotNews news = control.primary().news;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (!news.answers[i] || news.answers[i] == answered[i]) continue;
    answered[i] = news.answers[i];
    tellAll(answerJson(sensors[i], *news.answers[i]));
  }
}

void Console::Impl::watchMap() {
  const bool wanted =
      std::any_of(guests.begin(), guests.end(), [](const auto& guest) { return guest.second.wants_map; });
  if (options.map && wanted != is_map_wanted) options.map->want(wanted);
  is_map_wanted = wanted;
}

bool Console::Impl::isUpdateDue(const Guest& guest) const {
  if (!primary.update || primary.update == guest.update || guest.sent - guest.shown >= kMostUnderway) return false;
  return primary.picture != guest.picture || now() - guest.update_sent >= kUpdatePause;
}

Message Console::Impl::next(GuestId id) {
  const auto found = guests.find(id);
  if (found == guests.end()) return nullptr;
  Guest& guest = found->second;
  if (!guest.mail.empty()) {
    const Message message = guest.mail.front();
    guest.mail.pop_front();
    return message;
  }
  if (!guest.is_in) return nullptr;
  if (std::exchange(guest.robot, robot.version) != robot.version) return robot.message;
  if (std::exchange(guest.team, team.version) != team.version) return team.message;
  if (isUpdateDue(guest)) {
    const bool has_picture = primary.picture && primary.picture != guest.picture;
    if (guest.sent == guest.shown) guest.shown_at = now();
    guest.update = primary.update;
    guest.picture = primary.picture;
    guest.update_sent = now();
    ++guest.sent;
    return updates.of(primary, has_picture, guest.wants_sensors);
  }
  if (!guest.wants_map || !map_view) return nullptr;
  if (std::exchange(guest.map, map_world.version) != map_world.version) return map_world.message;
  if (map_view->world && map_view != guest.poses && now() - guest.poses_sent >= kPosesPause) {
    guest.poses = map_view;
    guest.poses_sent = now();
    return textMessage(posesJson(*map_view));
  }
  return nullptr;
}

void Console::Impl::tellAll(const std::string& json) {
  const Message message = textMessage(json);
  for (auto& [id, guest] : guests) {
    if (!guest.is_in || guest.mail.size() >= kMostMail) continue;
    guest.mail.push_back(message);
    server.wake(id);
  }
}

/// The wheel's holder first. Without news, those who have not yet seen all there is.
void Console::Impl::wakeAll(bool is_news) {
  if (wheel.holder != 0) server.wake(wheel.holder);
  for (const auto& [id, guest] : guests) {
    if (is_news || isUpdateDue(guest)) server.wake(id);
  }
}

Console::Console(const Options& options, const std::vector<RobotAddress>& team)
    : impl_(std::make_unique<Impl>(options, team)) {}
Console::~Console() = default;
int Console::port() const { return impl_->server.port(); }
void Console::serve(const std::function<bool()>& interrupted) { impl_->server.serve(interrupted); }

}  // namespace robosim
