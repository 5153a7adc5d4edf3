#include "remote/remote_control.h"

#include <algorithm>

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// Pause between a failed connection and the next attempt; after a refusal, which seldom changes, a longer one.
constexpr auto kPause = 1s;
constexpr auto kPauseAfterRefusal = 5s;
/// Maximum time for which the primary waits for secondaries that neither connect nor fail.
constexpr auto kSecondariesWithin = 3s;
/// Between two requests for the heat of the secondary robots.
constexpr auto kHeatPeriod = 1s;

std::size_t primaryOf(const std::vector<RobotAddress>& list) {
  const auto found = std::find_if(list.begin(), list.end(), [](const RobotAddress& robot) { return robot.primary; });
  return static_cast<std::size_t>(found - list.begin()) % list.size();
}

}  // namespace

PrimaryQueue::PrimaryQueue(std::size_t robots, std::size_t primary) {
  order_.push_back(primary);
  for (std::size_t robot = 0; robot < robots; ++robot) {
    if (robot != primary) order_.push_back(robot);
  }
}

std::optional<std::size_t> PrimaryQueue::next(const std::function<bool(std::size_t)>& is_fit) const {
  const auto found = std::find_if(order_.begin() + 1, order_.end(), is_fit);
  if (found == order_.end()) return std::nullopt;
  return *found;
}

void PrimaryQueue::switchTo(std::size_t robot) {
  if (robot == primary()) return;
  const auto found = std::find(order_.begin(), order_.end(), robot);
  std::rotate(order_.begin(), found, found + 1);                      // to the head, and all before it back by one
  std::rotate(order_.begin() + 1, order_.begin() + 2, order_.end());  // the old primary, now second, to the tail
}

struct RemoteControl::TeamMember {
  TeamMember(const std::string& robot, const ConnectOptions& connect_options, const std::function<void()>& on_news)
      : name(robot), address(connect_options.address), link(robot, connect_options, on_news) {}

  std::string name, address;
  RobotLink link;
  std::optional<Clock::time_point> connected;  ///< time of the last attempt
  std::optional<Clock::time_point> failed;     ///< time of its failure
};

RemoteControl::RemoteControl(const std::vector<RobotAddress>& list, const Options& options)
    : options_(options), primaries_(list.size(), primaryOf(list)), started_(options.now()) {
  for (const auto& robot : list) {
    ConnectOptions connect_options = options.connect_options;
    connect_options.address = robot.hostname + ":" + std::to_string(robot.port);
    members_.push_back(std::make_unique<TeamMember>(robot.name, connect_options, options.on_news));
  }
  members_[primaries_.primary()]->link.setLive(true);
}

RemoteControl::~RemoteControl() = default;

void RemoteControl::tick() {
  const auto now = options_.now();
  for (auto& member : members_) {
    const bool fails = member->connected && !member->failed && !member->link.isCalling();
    if (fails) member->failed = now;
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    TeamMember& member = *members_[i];
    const bool is_primary = i == primaries_.primary();
    const bool must_wait = !has_connected_primary_ && !areSecondariesSettled() && now - started_ < kSecondariesWithin;
    if (is_primary && must_wait) continue;
    const auto pause = member.link.news().was_refused ? kPauseAfterRefusal : kPause;
    if (!member.connected || (member.failed && now - *member.failed >= pause)) connect(member, !is_primary);
    if (is_primary) has_connected_primary_ = true;
  }
  requestHeat(now);
}

/// Of the secondary robots, whose updates are not subscribed to.
void RemoteControl::requestHeat(Clock::time_point now) {
  if (now - heat_requested_ < kHeatPeriod) return;
  heat_requested_ = now;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (i == primaries_.primary()) continue;
    const RobotNews news = members_[i]->link.news();
    const auto is_heat = [](const SensorInfo& sensor) { return sensor.kind == SensorKind::heat; };
    if (!news.is_up || std::none_of(news.info->sensors->begin(), news.info->sensors->end(), is_heat)) continue;
    members_[i]->link.send(makeOrder(OrderType::req_heat));
  }
}

void RemoteControl::connect(TeamMember& member, bool autonomous) {
  if (!member.connected) member.link.claim(options_.driver, autonomous);
  member.connected = options_.now();
  member.failed.reset();
  member.link.connect();
}

bool RemoteControl::areSecondariesSettled() const {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (i == primaries_.primary()) continue;
    const TeamMember& member = *members_[i];
    if (!member.failed && !(member.connected && member.link.news().is_up)) return false;
  }
  return true;
}

RemoteControl::Robot RemoteControl::robotAt(std::size_t index) const {
  return {members_[index]->name, members_[index]->address, members_[index]->link.news()};
}

std::vector<RemoteControl::Robot> RemoteControl::robots() const {
  std::vector<Robot> robots;
  for (const auto index : primaries_.order()) robots.push_back(robotAt(index));
  return robots;
}

RemoteControl::Robot RemoteControl::primary() const { return robotAt(primaries_.primary()); }

bool RemoteControl::switchPrimary() {
  const auto next = primaries_.next([&](std::size_t index) { return robotAt(index).isFit(); });
  if (next) makePrimary(*next);
  return next.has_value();
}

bool RemoteControl::switchTo(const std::string& name) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i]->name != name || !robotAt(i).isFit()) continue;
    makePrimary(i);
    return true;
  }
  return false;
}

void RemoteControl::makePrimary(std::size_t index) {
  if (index == primaries_.primary()) return;
  members_[primaries_.primary()]->link.setLive(false);
  send(modeOrder(true));
  primaries_.switchTo(index);
  claimPrimary();
  members_[index]->link.setLive(true);
}

void RemoteControl::setDriver(const std::string& driver) {
  options_.driver = driver;
  claimPrimary();
}

void RemoteControl::claimPrimary() { members_[primaries_.primary()]->link.claim(options_.driver, false); }

void RemoteControl::send(const v1::ControlRequest& order) { members_[primaries_.primary()]->link.send(order); }

}  // namespace robosim
