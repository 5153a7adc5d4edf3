#include "serving/topic_feed.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "run/outputs/intervention_note.h"

namespace robosim {

namespace {

/// Index of a robot's topic that the feed leaves out.
constexpr std::size_t kNotOffered = ~std::size_t{0};

}  // namespace

/// Passes the messages of a robot to the outlet.
class TopicFeed::Sink final : public TopicSink {
 public:
  Sink(TopicOutlet& outlet, const std::vector<std::size_t>& topics, Audience audience, std::uint64_t time_ns)
      : outlet_(outlet), topics_(topics), audience_(audience), time_ns_(time_ns) {}

  bool wants(std::size_t topic) const override {
    return topics_[topic] != kNotOffered && outlet_.wants(topics_[topic], audience_);
  }
  std::vector<std::uint8_t>& beginMessage(std::size_t topic) override {
    topic_ = topics_[topic];
    bytes_.clear();
    return bytes_;
  }
  void endMessage() override {
    outlet_.send(topic_, audience_, time_ns_, std::move(bytes_), false);
    bytes_ = {};
  }

 private:
  TopicOutlet& outlet_;
  const std::vector<std::size_t>& topics_;
  Audience audience_;
  std::uint64_t time_ns_;
  std::size_t topic_ = 0;
  std::vector<std::uint8_t> bytes_;
};

TopicFeed::TopicFeed(TopicOutlet& outlet, std::shared_ptr<const Model> model, const State& state,
                     const FeedOptions& options)
    : outlet_(outlet), model_(std::move(model)), state_(state), options_(options), world_(model_) {
  const TopicForm& form = options_.form;
  clock_ = indexOf({"/clock", &ros::typeOf<ros::Clock>(), TopicDelivery::steady});
  if (form.frames == FrameNames::prefixed) {
    indexOf({"/tf_static", &ros::typeOf<ros::TFMessage>(), TopicDelivery::latched});
  }
  map_ = indexOf({"/map", &ros::typeOf<ros::OccupancyGrid>(), TopicDelivery::latched});
  objects_ = indexOf({"/objects", &ros::typeOf<ros::MarkerArray>(), TopicDelivery::latched});
  interventions_ = indexOf({"/interventions", &ros::typeOf<ros::String>(), TopicDelivery::steady});
  events_ = indexOf({"/events", &ros::typeOf<ros::String>(), TopicDelivery::steady});
  markers_topic_ = indexOf(RobotMarkers::topic());
  for (const auto& robot : model_->fleet.robots) {
    markers_.add(robot.info);
    const RobotTopics& topics = robots_.emplace_back(robot.info, form);
    indexOf(topics.staticTopic());
    auto& indices = topics_of_robot_.emplace_back();
    auto& pictures = pictures_of_robot_.emplace_back();
    for (const auto& topic : topics.topics()) {
      const bool is_offered = options_.has_commands || !topic.name.ends_with("/cmd_vel");
      indices.push_back(is_offered ? indexOf(topic) : kNotOffered);
      if (topic.type == &ros::typeOf<ros::CompressedImage>()) pictures.push_back(indices.back());
    }
    kept_.emplace_back(robot.info.sensors, options_.leaves_out_equal);
  }
  was_absent_.resize(robots_.size());
}

std::size_t TopicFeed::indexOf(const Topic& topic) {
  const auto [found, is_new] = index_of_.try_emplace(topic.name, topics_.size());
  if (is_new) topics_.push_back(topic);
  return found->second;
}

std::vector<std::uint8_t> TopicFeed::pictured() const {
  std::vector<std::uint8_t> robots(robots_.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i] = std::any_of(pictures_of_robot_[i].begin(), pictures_of_robot_[i].end(),
                            [this](std::size_t topic) { return outlet_.isSubscribed(topic); });
  }
  return robots;
}

void TopicFeed::poll() {
  if (!outlet_.hasFresh()) return;
  outlet_.beginRound(nanosecondsOf(state_.time.seconds()));
  sendLatched(Audience::fresh);
  sendRobots(Audience::fresh);
  sendMarkers(Audience::fresh);
  outlet_.endRound();
}

void TopicFeed::stepped() {
  const State& state = state_;
  const std::uint64_t time_ns = nanosecondsOf(state.time.seconds());
  const std::string winner = state.winner() ? model_->fleet.robots[*state.winner()].info.name : "";
  outlet_.beginRound(time_ns);
  if (outlet_.wants(clock_, Audience::all)) {
    send(topicMessage("/clock", TopicDelivery::steady, time_ns, ros::Clock{timeOf(time_ns)}), Audience::all);
  }
  if (outlet_.wants(objects_, Audience::all) || outlet_.wants(interventions_, Audience::all) ||
      outlet_.wants(events_, Audience::all)) {
    for (auto& message : world_.of(state.objects, notesBefore(state, state.time.step, false), winner, time_ns)) {
      send(std::move(message), Audience::all);
    }
  } else {
    world_.startFrom(state.objects, winner);
  }
  sendLatched(std::exchange(is_restarted_, false) ? Audience::all : Audience::fresh);
  sendRobots(Audience::all);
  sendMarkers(Audience::all);
  outlet_.endRound();
}

void TopicFeed::restart() {
  for (auto& kept : kept_) kept.forget();
  is_restarted_ = true;
}

/// The state that is not sent in each step.
void TopicFeed::sendLatched(Audience audience) {
  const std::uint64_t time_ns = nanosecondsOf(state_.time.seconds());
  if (options_.form.frames == FrameNames::prefixed) {
    sendMounts(robots_, audience, time_ns);
  } else {
    for (const auto& robot : robots_) sendMounts({&robot, 1}, audience, time_ns);
  }
  if (outlet_.wants(map_, audience)) send(world_.map(time_ns), audience, true);
  if (outlet_.wants(objects_, audience)) {
    send(world_.objects(state_.objects, time_ns), audience, true);
  }
}

/// Sends the poses of the sensors of robots that share a topic for them.
void TopicFeed::sendMounts(std::span<const RobotTopics> robots, Audience audience, std::uint64_t time_ns) {
  const std::string topic = robots.empty() ? "/tf_static" : robots[0].staticTopic().name;
  if (outlet_.wants(index_of_.at(topic), audience)) {
    send(staticTransforms(robots, time_ns), audience, true);
  }
}

void TopicFeed::sendRobots(Audience audience) {
  const State& state = state_;
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
    Sink sink(outlet_, topics_of_robot_[i], audience, nanosecondsOf(readings.time.seconds()));
    robots_[i].write(readings, RobotTruth{state.world_from_robot[i], trueVelocity(state, i)}, state.commands[i], kept,
                     sink);
  }
}

void TopicFeed::sendMarkers(Audience audience) {
  if (!outlet_.wants(markers_topic_, audience)) return;
  const State& state = state_;
  std::vector<std::optional<mrpt::math::TPose2D>> poses;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    poses.push_back(state.isAbsent(i) ? std::nullopt : std::optional(state.world_from_robot[i]));
  }
  const std::uint64_t time_ns = nanosecondsOf(state.time.seconds());
  const auto message = markers_.message(poses, time_ns);
  outlet_.send(markers_topic_, audience, time_ns, {message.begin(), message.end()}, false);
}

bool TopicFeed::isWanted(std::size_t robot, Audience audience) const {
  const auto& topics = topics_of_robot_[robot];
  return std::any_of(topics.begin(), topics.end(),
                     [&](std::size_t topic) { return topic != kNotOffered && outlet_.wants(topic, audience); });
}

void TopicFeed::send(TopicMessage message, Audience audience, bool latest_only) {
  outlet_.send(index_of_.at(message.topic.name), audience, message.time_ns, std::move(message.data), latest_only);
}

}  // namespace robosim
