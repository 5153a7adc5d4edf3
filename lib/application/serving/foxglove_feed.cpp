#include "serving/foxglove_feed.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "run/outputs/intervention_note.h"

namespace robosim {

/// Passes the messages of a robot to the hub.
class FoxgloveFeed::Sink final : public TopicSink {
 public:
  Sink(foxglove::Hub& hub, const std::vector<std::size_t>& channels, Audience audience, std::uint64_t time_ns)
      : hub_(hub), channels_(channels), audience_(audience), time_ns_(time_ns) {}

  bool wants(std::size_t topic) const override { return hub_.wants(channels_[topic], audience_); }
  std::vector<std::uint8_t>& beginMessage(std::size_t topic) override {
    channel_ = channels_[topic];
    bytes_.clear();
    return bytes_;
  }
  void endMessage() override {
    hub_.send(channel_, audience_, time_ns_, std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes_)));
    bytes_ = {};
  }

 private:
  foxglove::Hub& hub_;
  const std::vector<std::size_t>& channels_;
  Audience audience_;
  std::uint64_t time_ns_;
  std::size_t channel_ = 0;
  std::vector<std::uint8_t> bytes_;
};

FoxgloveFeed::FoxgloveFeed(foxglove::Hub& hub, const Environment& environment)
    : hub_(hub), environment_(environment), world_(environment.model()) {
  clock_ = channelOf({"/clock", &ros::typeOf<ros::Clock>(), TopicDelivery::steady});
  static_transforms_ = channelOf({"/tf_static", &ros::typeOf<ros::TFMessage>(), TopicDelivery::latched});
  map_ = channelOf({"/map", &ros::typeOf<ros::OccupancyGrid>(), TopicDelivery::latched});
  objects_ = channelOf({"/objects", &ros::typeOf<ros::MarkerArray>(), TopicDelivery::latched});
  interventions_ = channelOf({"/interventions", &ros::typeOf<ros::String>(), TopicDelivery::steady});
  events_ = channelOf({"/events", &ros::typeOf<ros::String>(), TopicDelivery::steady});
  for (const auto& robot : environment.fleet().robots) {
    const RobotTopics& topics = robots_.emplace_back(robot.info);
    auto& channels = channels_of_robot_.emplace_back();
    auto& pictures = pictures_of_robot_.emplace_back();
    for (const auto& topic : topics.topics()) {
      channels.push_back(channelOf(topic));
      if (topic.type == &ros::typeOf<ros::CompressedImage>()) pictures.push_back(channels.back());
    }
    kept_.emplace_back(robot.info.sensors);
  }
  was_absent_.resize(robots_.size());
}

std::size_t FoxgloveFeed::channelOf(const Topic& topic) {
  const auto [found, is_new] = channel_of_.try_emplace(topic.name, topics_.size());
  if (is_new) topics_.push_back(topic);
  return found->second;
}

std::vector<foxglove::Channel> FoxgloveFeed::channels() const {
  std::vector<foxglove::Channel> channels;
  for (const auto& topic : topics_) {
    channels.push_back({topic.name, "cdr", topic.type->name, topic.type->definition(), "ros2msg"});
  }
  return channels;
}

std::vector<std::uint8_t> FoxgloveFeed::pictured() const {
  std::vector<std::uint8_t> robots(robots_.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i] = std::any_of(pictures_of_robot_[i].begin(), pictures_of_robot_[i].end(),
                            [this](std::size_t channel) { return hub_.isSubscribed(channel); });
  }
  return robots;
}

void FoxgloveFeed::poll() {
  if (!hub_.hasFresh()) return;
  hub_.beginRound();
  hub_.sendTime(nanosecondsOf(environment_.time().seconds()));
  sendLatched();
  sendRobots(Audience::fresh);
  hub_.endRound();
}

void FoxgloveFeed::stepped() {
  const State& state = environment_.state();
  const std::uint64_t time_ns = nanosecondsOf(state.time.seconds());
  const std::string winner = state.winner() ? environment_.robotNames()[*state.winner()] : "";
  hub_.beginRound();
  hub_.sendTime(time_ns);
  if (hub_.wants(clock_, Audience::all)) {
    send(topicMessage("/clock", TopicDelivery::steady, time_ns, ros::Clock{timeOf(time_ns)}), Audience::all);
  }
  if (hub_.wants(objects_, Audience::all) || hub_.wants(interventions_, Audience::all) ||
      hub_.wants(events_, Audience::all)) {
    for (const auto& message : world_.of(state.objects, notesBefore(state, state.time.step, false), winner, time_ns)) {
      send(message, Audience::all);
    }
  } else {
    world_.startFrom(state.objects, winner);
  }
  sendLatched();
  sendRobots(Audience::all);
  hub_.endRound();
}

/// The state that is not sent in each step, to those who have subscribed since the last round.
void FoxgloveFeed::sendLatched() {
  const std::uint64_t time_ns = nanosecondsOf(environment_.time().seconds());
  if (hub_.wants(static_transforms_, Audience::fresh)) {
    send(staticTransforms(robots_, time_ns), Audience::fresh, true);
  }
  if (hub_.wants(map_, Audience::fresh)) send(world_.map(time_ns), Audience::fresh, true);
  if (hub_.wants(objects_, Audience::fresh)) {
    send(world_.objects(environment_.state().objects, time_ns), Audience::fresh, true);
  }
}

void FoxgloveFeed::sendRobots(Audience audience) {
  const State& state = environment_.state();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const bool is_absent = state.isAbsent(i);
    if (std::exchange(was_absent_[i], is_absent) != is_absent) kept_[i].forget();
    if (is_absent) continue;
    if (!isWanted(i, audience)) continue;
    const Readings& readings = state.readings[i];
    std::vector<std::uint8_t> kept;
    for (std::size_t sensor = 0; audience == Audience::all && sensor < readings.measurements.size(); ++sensor) {
      kept.push_back(kept_[i].isKept(sensor, readings));
    }
    Sink sink(hub_, channels_of_robot_[i], audience, nanosecondsOf(readings.time.seconds()));
    robots_[i].write(readings, state.world_from_robot[i], state.commands[i], kept, sink);
  }
}

bool FoxgloveFeed::isWanted(std::size_t robot, Audience audience) const {
  const auto& channels = channels_of_robot_[robot];
  return std::any_of(channels.begin(), channels.end(),
                     [&](std::size_t channel) { return hub_.wants(channel, audience); });
}

void FoxgloveFeed::send(const TopicMessage& message, Audience audience, bool latest_only) {
  hub_.send(channel_of_.at(message.topic.name), audience, message.time_ns,
            std::make_shared<const std::vector<std::uint8_t>>(message.data), latest_only);
}

}  // namespace robosim
