#include "ros2/ros2_hardware.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/portable_pose.h"
#include "hardware/scan_geometry.h"
#include "ros/cdr.h"
#include "topics/topic.h"

namespace robosim {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPoll{50};
constexpr milliseconds kShortPoll{2};
/// Time in which topics appear after the odometry, and their first messages.
constexpr milliseconds kTopicsMin{500}, kTopicsMax{3000};
constexpr std::chrono::seconds kStopMax{5};
constexpr double kStanding_mps = 0.005, kStanding_radps = 0.01;
constexpr std::uint64_t kNsPerS = 1'000'000'000;

/// A sensor of the kind, if the type has none.
void addIfMissing(std::vector<SensorInfo>& sensors, SensorKind kind) {
  const auto is_kind = [&](const SensorInfo& sensor) { return sensor.kind == kind; };
  if (std::any_of(sensors.begin(), sensors.end(), is_kind)) return;
  SensorInfo added;
  added.kind = kind;
  added.label = nameOf(kind);
  if (kind == SensorKind::laser) added.beams = {{}, {{0, 0, 0, 0.01, 0, 0}}};  // until the first scan
  sensors.push_back(std::move(added));
}

/// The stamp with which a message with a header begins; of one without, the time since the start of this machine.
std::uint64_t stampOf(const ros::MessageType& type, std::span<const std::uint8_t> message) {
  ros::Time stamp;
  if (&type != &ros::typeOf<ros::UInt8MultiArray>()) ros::CdrReader(message).read(stamp);
  if (const std::int64_t stamp_ns = nanosecondsOf(stamp); stamp_ns > 0) return static_cast<std::uint64_t>(stamp_ns);
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Ros2Hardware::Clock::now().time_since_epoch()).count());
}

}  // namespace

Ros2Hardware::Ros2Hardware(std::shared_ptr<dds::Participant> participant, Options options)
    : participant_(std::move(participant)), options_(std::move(options)), names_{options_.name} {
  info_ = options_.type;
  info_.name = options_.name;
  std::vector<SensorInfo> sensors = info_.sensors ? *info_.sensors : std::vector<SensorInfo>();
  for (const SensorKind kind : {SensorKind::odometry, SensorKind::laser, SensorKind::battery}) {
    addIfMissing(sensors, kind);
  }
  info_.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  subscribe();
  awaitRobot();
  describe();
  takeReadings();
}

Ros2Hardware::~Ros2Hardware() {
  if (!is_closed_) sendSpeeds(0, 0);
}

std::string Ros2Hardware::topicName(const std::string& below) const {
  const auto other = options_.topics.find(below);
  return other == options_.topics.end() ? options_.prefix + "/" + below : other->second;
}

void Ros2Hardware::subscribe() {
  const Topic twist{topicName("cmd_vel"), &ros::typeOf<ros::Twist>()};
  twist_ = participant_->write(twist);
  twist_stamped_ = participant_->write({twist.name, &ros::typeOf<ros::TwistStamped>()});
  const auto on_transforms = [this](const dds::Sample& sample) {
    const auto message = ros::decode<ros::TFMessage>(sample.message);
    const std::lock_guard lock(mutex_);
    for (const auto& transform : message.transforms) frames_.add(transform, 0, true);
  };
  for (const std::string& prefix : {std::string(), options_.prefix}) {
    if (prefix.empty() && !transforms_.empty()) continue;
    const Topic topic{prefix + "/tf_static", &ros::typeOf<ros::TFMessage>(), TopicDelivery::latched};
    transforms_.push_back(participant_->read(topic, dds::Receipt::reliable, on_transforms));
  }
  std::map<std::string, std::string> unused = options_.topics;
  unused.erase("cmd_vel");
  for (std::size_t i = 0; i < info_.sensors->size(); ++i) {
    for (const SensorSource& source : sourcesOf((*info_.sensors)[i])) {
      unused.erase(source.topic);
      auto channel = std::make_unique<Channel>();
      channel->topic = topicName(source.topic);
      channel->type = source.type;
      channel->sensor = i;
      channel->beam = source.beam;
      const bool is_odometry = source.type == &ros::typeOf<ros::Odometry>();
      channels_.insert(is_odometry ? channels_.begin() : channels_.end(), std::move(channel));
    }
  }
  if (!unused.empty()) {
    throw ConfigError("the robot type '" + info_.type->model + "' has no topic '" + unused.begin()->first +
                      "' for which another name could be given; it has " + listed([&] {
                        std::vector<std::string> names{"cmd_vel"};
                        for (const auto& sensor : *info_.sensors) {
                          for (const auto& source : sourcesOf(sensor)) names.push_back(source.topic);
                        }
                        return names;
                      }()));
  }
  for (const auto& channel : channels_) {
    channel->reader =
        participant_->read({channel->topic, channel->type, TopicDelivery::sensor}, dds::Receipt::best_effort,
                           [this, to = channel.get()](const dds::Sample& sample) { receive(*to, sample); });
  }
}

void Ros2Hardware::receive(Channel& channel, const dds::Sample& sample) {
  const std::uint64_t stamp_ns = stampOf(*channel.type, sample.message);
  const std::lock_guard lock(mutex_);
  channel.message.assign(sample.message.begin(), sample.message.end());
  channel.is_new = true;
  if (channel.stamp_ns > 0 && stamp_ns > channel.stamp_ns) channel.interval_ns = stamp_ns - channel.stamp_ns;
  channel.stamp_ns = stamp_ns;
  channel.arrived_at = Clock::now();
  arrived_.notify_all();
}

void Ros2Hardware::awaitRobot() {
  const auto start = Clock::now();
  const Channel& odometry = *channels_.front();
  std::unique_lock lock(mutex_);
  std::optional<Clock::time_point> appeared;
  while (true) {
    const auto now = Clock::now();
    if (!appeared && odometry.is_new) appeared = now;
    const bool have_all = std::all_of(channels_.begin(), channels_.end(), [](const auto& channel) {
      return channel->is_new || channel->reader->writers() == 0;
    });
    if (appeared && now - *appeared >= kTopicsMin && (have_all || now - *appeared >= kTopicsMax)) return;
    if (options_.interrupted()) throw Interrupted("interrupted; no robot has answered yet");
    if (!appeared && now - start > kAppearanceMax) {
      throw RobotLinkError("no robot publishes nav_msgs/msg/Odometry on " + odometry.topic + " (" + options_.where +
                           "); check the namespace, the domain, and that this machine and the robot may reach each "
                           "other");
    }
    arrived_.wait_for(lock, kPoll);
  }
}

void Ros2Hardware::describe() {
  std::vector<std::string> missing{"CheckWin"};
  std::vector<SensorInfo> sensors;
  std::vector<std::unique_ptr<Channel>> channels;
  const std::lock_guard lock(mutex_);
  try {
    base_frame_ = frameName(ros::decode<ros::Odometry>(channels_.front()->message).child_frame_id);
  } catch (const ros::CdrError& error) {
    throw RobotLinkError(channels_.front()->topic + " has no nav_msgs/msg/Odometry: " + error.what());
  }
  for (std::size_t i = 0; i < info_.sensors->size(); ++i) {
    SensorInfo sensor = (*info_.sensors)[i];
    const auto is_of = [&](const auto& channel) { return channel && channel->sensor == i; };
    const bool is_there = std::any_of(channels_.begin(), channels_.end(), [&](const auto& channel) {
      if (!is_of(channel)) return false;
      if (channel->type == &ros::typeOf<ros::LaserScan>()) return channel->is_new && becomeScanner(sensor, *channel);
      return channel->is_new || channel->reader->writers() > 0;
    });
    if (!is_there) {
      missing.push_back(sensor.label);
      continue;
    }
    for (auto& channel : channels_) {
      if (!is_of(channel)) continue;
      channel->sensor = sensors.size();
      channel->readings_max_ns = measuresEchoes(sensor) ? kReadingMax_ns : 0;
      channels.push_back(std::move(channel));
    }
    readings_.measurements.push_back(blankMeasurement(sensor));
    sensors.push_back(std::move(sensor));
  }
  // Topics of sensors that the robot does not have are no longer read.
  std::erase(channels_, nullptr);
  unread_ = std::move(channels_);
  channels_ = std::move(channels);
  const auto odometry = std::find_if(channels_.begin(), channels_.end(), [](const auto& channel) {
    return channel->type == &ros::typeOf<ros::Odometry>();
  });
  std::rotate(channels_.begin(), odometry, odometry + 1);
  info_.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  readings_.time.period_s = kPeriod_s;
  start_ns_ = step_ns_ = channels_.front()->stamp_ns;
  options_.log("connected to " + (options_.prefix.empty() ? std::string("the robot") : options_.prefix) + " (" +
               options_.where + "), as a " + info_.type->model + "; not available: " + listed(missing));
}

bool Ros2Hardware::becomeScanner(SensorInfo& sensor, const Channel& channel) {
  try {
    const auto scan = ros::decode<ros::LaserScan>(channel.message);
    sensor = scannerOf(scan, mountOf(scan, sensor), sensor);
    return true;
  } catch (const std::exception& error) {
    options_.log(channel.topic + " cannot be used: " + error.what());
    return false;
  }
}

mrpt::math::TPose3D Ros2Hardware::mountOf(const ros::LaserScan& scan, const SensorInfo& of_type) {
  const std::string frame = frameName(scan.header.frame_id);
  if (frame == base_frame_) return {};
  if (const auto found = frames_.find(base_frame_, frame, 0)) return found->asTPose();
  const auto geometry = toScanGeometry(of_type.beams);
  options_.log("/tf_static has no transform from '" + base_frame_ + "' to '" + frame + "'; the place of '" +
               of_type.label + "' is that of the robot type " + info_.type->model);
  return geometry ? geometry->robot_from_middle : mrpt::math::TPose3D();
}

void Ros2Hardware::send(const std::string& to, const std::string&) {
  throw std::invalid_argument("a message to '" + to + "': a robot of ROS 2 is alone, and exchanges no messages");
}

bool Ros2Hardware::nextStep() { return awaitStep(options_.interrupted); }

void Ros2Hardware::close(const std::function<void()>& each_step) {
  is_closed_ = true;
  if (command_.activity == Activity::active) command_ = {.activity = Activity::halted};
  const auto start = Clock::now();
  while (awaitStep([&] { return Clock::now() - start >= kStopMax; })) {
    each_step();
    const auto& odometry = std::get<Odometry>(readings_.measurements[channels_.front()->sensor]);
    if (std::abs(odometry.speed_mps) < kStanding_mps && std::abs(odometry.turn_radps) < kStanding_radps) break;
  }
}

bool Ros2Hardware::awaitStep(const std::function<bool()>& is_over) {
  sendCommand();
  const auto start = Clock::now();
  bool has_warned = false;
  std::unique_lock lock(mutex_);
  while (!isStepComplete()) {
    lock.unlock();
    if (is_over()) return false;
    const auto silent = Clock::now() - start;
    if (silent > kSilenceMax) {
      throw RobotLinkError("the robot has sent no odometry on " + channels_.front()->topic + " for " +
                           std::to_string(kSilenceMax.count()) + " s; it was sent a command to stop");
    }
    if (silent > kSilenceWarning && !std::exchange(has_warned, true)) {
      options_.log("the robot has sent no odometry for " + std::to_string(kSilenceWarning.count()) + " s");
      sendSpeeds(0, 0);
    }
    lock.lock();
    arrived_.wait_for(lock, isOdometryDue() ? kShortPoll : kPoll);
  }
  lock.unlock();
  was_silent_ = has_warned;
  takeReadings();
  return true;
}

bool Ros2Hardware::isOdometryDue() const {
  const Channel& odometry = *channels_.front();
  if (!odometry.is_new) return false;
  constexpr auto kPeriod_ns = static_cast<std::uint64_t>(kPeriod_s * kNsPerS);
  // A clock that goes back is that of a simulation that was started again.
  return odometry.stamp_ns < step_ns_ || odometry.stamp_ns + odometry.interval_ns / 2 >= step_ns_ + kPeriod_ns;
}

bool Ros2Hardware::isStepComplete() const {
  if (!isOdometryDue()) return false;
  const Channel& odometry = *channels_.front();
  if (Clock::now() - odometry.arrived_at >= options_.together) return true;
  return std::none_of(channels_.begin(), channels_.end(), [&](const auto& channel) {
    // One that should have a message of this moment by now, and had one last time.
    const std::uint64_t next_ns = channel->stamp_ns + channel->interval_ns;
    return channel->interval_ns > 0 && next_ns <= odometry.stamp_ns + channel->interval_ns / 4 &&
           next_ns + 2 * channel->interval_ns > odometry.stamp_ns;
  });
}

void Ros2Hardware::sendCommand() {
  const bool may_move = base_.stop_reason.empty() && command_.activity == Activity::active && !command_.emergency_stop;
  const auto limited = [&](double value, double limit) {
    return may_move && std::isfinite(value) ? std::clamp(value, -limit, limit) : 0;
  };
  sendSpeeds(limited(command_.speed_mps, info_.type->limits.speed_max_mps),
             limited(command_.turn_radps, info_.type->limits.turn_max_radps),
             limited(command_.lateral_mps, info_.type->limits.lateral_max_mps));
}

void Ros2Hardware::sendSpeeds(double speed_mps, double turn_radps, double lateral_mps) {
  ros::Twist twist;
  twist.linear.x = speed_mps;
  twist.linear.y = lateral_mps;
  twist.angular.z = turn_radps;
  const auto write = [](dds::Writer& writer, const auto& message) {
    std::vector<std::uint8_t> bytes;
    ros::encode(message, bytes);
    writer.write(std::move(bytes));
  };
  // A robot reads one of both types. One that reads both takes them for commands of two programs.
  if (twist_->readers() > 0 || twist_stamped_->readers() == 0) {
    write(*twist_, twist);
  } else {
    write(*twist_stamped_, ros::TwistStamped{{timeOf(step_ns_), base_frame_}, twist});
  }
}

void Ros2Hardware::takeReadings() {
  {
    const std::lock_guard lock(mutex_);
    for (const auto& channel : channels_) {
      if (!std::exchange(channel->is_new, false)) {
        if (auto* const image = std::get_if<Image>(&readings_.measurements[channel->sensor])) image->jpeg.clear();
        continue;
      }
      std::string fault;
      try {
        readMeasurement((*info_.sensors)[channel->sensor], channel->beam, channel->message,
                        readings_.measurements[channel->sensor]);
        channel->read_ns = channel->stamp_ns;
      } catch (const std::exception& error) {
        fault = error.what();
      }
      if (fault != channel->fault && !fault.empty()) options_.log(channel->topic + " cannot be read: " + fault);
      channel->fault = fault;
    }
    const Channel& odometry = *channels_.front();
    const std::uint64_t before = step_ns_;
    step_ns_ = odometry.stamp_ns;
    if (step_ns_ < start_ns_ || step_ns_ < before) start_ns_ = step_ns_ - std::min(step_ns_, before - start_ns_);
    const double since_start_s = static_cast<double>(step_ns_ - start_ns_) / kNsPerS;
    const auto step = static_cast<std::uint64_t>(std::llround(since_start_s / kPeriod_s));
    if (has_taken_) readings_.time.step = std::max(readings_.time.step + 1, step);
    has_taken_ = true;
  }
  auto& odometry = std::get<Odometry>(readings_.measurements[channels_.front()->sensor]);
  if (!odom_from_start_) odom_from_start_ = odometry.odom_from_robot;
  odometry.odom_from_robot = portable::relative(*odom_from_start_, odometry.odom_from_robot);
  takeBaseState();
}

void Ros2Hardware::takeBaseState() {
  const std::string before = base_.stop_reason;
  base_.motors_enabled = motors_wanted_;
  base_.stop_reason = was_silent_       ? "the robot had sent nothing for a while"
                      : !motors_wanted_ ? "the motors are disabled"
                                        : oldReading();
  if (base_.stop_reason == before) return;
  options_.log(base_.stop_reason.empty() ? "the robot may move again; resolved: " + before
                                         : "the robot stops: " + base_.stop_reason);
}

std::string Ros2Hardware::oldReading() {
  const std::lock_guard lock(mutex_);
  for (const auto& channel : channels_) {
    if (channel->readings_max_ns == 0 || channel->read_ns == 0) continue;
    const std::uint64_t limit_ns = std::max(channel->readings_max_ns, 3 * channel->interval_ns);
    if (step_ns_ > channel->read_ns + limit_ns) return "the readings of " + channel->topic + " are old";
  }
  return {};
}

}  // namespace robosim
