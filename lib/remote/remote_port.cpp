#include "remote/remote_port.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "base/error_list.h"
#include "net/open_port.h"
#include "net/remote.grpc.pb.h"
#include "net/robot_wire.h"
#include "net/server_stream.h"

namespace robosim {
namespace {

/// What a robot tells, in the order in which it goes out when several are due. One of each waits at most.
enum Topic : std::size_t { kState, kHeat, kLaser, kSonar, kAll, kTopics };

struct OnRequest {
  Topic topic;
  RemoteType type;
  SensorKind sensor;
};
constexpr std::array kOnRequest{OnRequest{kHeat, RemoteType::req_heat, SensorKind::heat},
                                OnRequest{kLaser, RemoteType::req_laser, SensorKind::laser},
                                OnRequest{kSonar, RemoteType::req_sonar, SensorKind::sonar}};

/// What of a state is told at once; the rest may wait until it is asked for.
auto newsIn(const RemoteState& state) {
  return std::tie(state.autonomous, state.driver, state.activity, state.why_stopped, state.winner, state.win_refusals);
}

/// A camera's newest picture, which a control that misses steps must not miss too.
struct Picture {
  std::optional<std::uint64_t> step;  ///< none before its first picture
  std::string jpeg;
};

}  // namespace

/// Everything is called with the mutex held, but what says otherwise.
struct RemotePort::Impl final
    : public wire::RemoteControl::WithRawCallbackMethod_Control<wire::RemoteControl::Service> {
  class Stream;

  /// A robot, and who has it.
  struct Seat {
    RemoteControlRobot* robot;
    Stream* driver = nullptr;
    RemoteState told;               ///< what everyone was told last
    std::vector<Picture> pictures;  ///< by sensor; empty for all but cameras

    const RobotInfo& info() const { return robot->hardware().info(); }
    const Readings& readings() const { return robot->hardware().readings(); }
    void keepPictures();
  };

  Impl(const Options& the_options, const Run& the_run, const std::vector<RemoteControlRobot*>& robots);
  ~Impl() override;

  /// gRPC calls this when a remote control connects, without the mutex.
  RawStream* Control(grpc::CallbackServerContext* context) override;

  void init(Stream& stream, const RemoteOrder& order);
  void obey(Stream& stream, const RemoteOrder& order);
  void letGo(Stream& stream);
  void tellStateOf(const Seat& seat);
  void tell();        ///< without the mutex
  void sayGoodbye();  ///< without the mutex

  Options options;
  Run run;
  std::mutex mutex;
  std::vector<Seat> seats;
  std::vector<std::shared_ptr<Stream>> streams;
  bool is_over = false;
  OpenPort open;
};

/// One remote control with one robot.
class RemotePort::Impl::Stream final : public ServerStream<wire::ToRobot, wire::FromRobot> {
 public:
  Stream(Impl& port, grpc::CallbackServerContext* context)
      : ServerStream(context), peer(context->peer()), port_(port) {}

  void received(const wire::ToRobot& message) override {
    const RemoteOrder order = decode(message);
    const std::lock_guard lock(port_.mutex);
    if (is_gone_) return;
    if (order.type == RemoteType::init) {
      port_.init(*this, order);
    } else if (seat) {
      port_.obey(*this, order);
    } else {
      throw WireError("the first message of a remote control must be its INIT");
    }
  }
  void refuse(const WireError& error) override {
    const std::lock_guard lock(port_.mutex);
    hangUp({error.code(), error.what()});
  }
  void drained() override {
    const std::lock_guard lock(port_.mutex);
    sendNext();
  }
  void ended() override {
    const std::lock_guard lock(port_.mutex);
    if (hasRobot()) port_.options.log(who() + " has gone");
    port_.letGo(*this);
    std::erase_if(port_.streams, [&](const auto& stream) { return stream.get() == this; });
  }

  void hangUp(const grpc::Status& status) {
    if (std::exchange(is_gone_, true)) return;
    port_.options.log(who() + ": hung up on: " + status.error_message());
    port_.letGo(*this);
    end(status);
  }

  bool hasRobot() const { return seat && seat->driver == this; }
  grpc::Status may(Right right, const std::string& robot) const {
    return port_.options.access.check(*context(), right, std::span(&robot, right == Right::drive ? 1 : 0));
  }
  std::string who() const {
    return (name.empty() ? "a remote control" : inQuotes(name)) + " (" + peer + ")" +
           (seat ? " at robot " + seat->robot->name() : "");
  }

  /// At its first INIT, and never another.
  void sitDown(Seat& at) {
    seat = &at;
    wants_welcome_ = true;
    told_pictures_.assign(at.pictures.size(), std::nullopt);
    encoded_pictures_ = told_pictures_;
  }
  void ask(Topic topic) { asked_[topic] = true; }

  void tellState() {
    wire::FromRobot& message = compose(kState, RemoteType::init_ack);
    if (wants_welcome_) {
      RobotsWelcome welcome{port_.run.world, "", port_.run.seed, port_.run.period_s, {{seat->info(), 0, ""}}, {}};
      encode(welcome, *message.mutable_welcome());
    }
    sendNext();
  }
  /// Tells of this step what was asked for: by the thread that steps the robot.
  void tellReadings() {
    for (const auto& of : kOnRequest) {
      if (asked_[of.topic]) tellSensor(of);
    }
    if (asked_[kAll]) tellAll();
    sendNext();
  }

  /// The run is over: with a last word on how it ended.
  void sayGoodbye() {
    if (seat && !is_gone_) {
      compose(kState, RemoteType::init_ack);
      draft().Swap(&due_[kState]);
      post();
    }
    is_gone_ = true;
    end(grpc::Status::OK);
  }

  std::string peer, name;
  Seat* seat = nullptr;  ///< null before its INIT

 private:
  wire::FromRobot& compose(Topic topic, RemoteType type) {
    wire::FromRobot& message = due_[topic];
    message.Clear();
    is_due_[topic] = true;
    message.set_type(static_cast<wire::RemoteType>(type));
    RemoteState state = seat->robot->state();
    state.is_yours = hasRobot();
    encode(state, *message.mutable_state());
    return message;
  }

  void tellSensor(const OnRequest& of) {
    wire::FromRobot& message = compose(of.topic, of.type);
    message.set_step(seat->readings().time.step);
    const auto& sensors = *seat->info().sensors;
    const auto found =
        std::find_if(sensors.begin(), sensors.end(), [&](const SensorInfo& s) { return s.kind == of.sensor; });
    if (found == sensors.end()) return;
    const auto slot = static_cast<std::size_t>(found - sensors.begin());
    message.set_sensor(static_cast<std::uint32_t>(slot));
    encode(seat->readings().measurements[slot], *message.mutable_measurement());
  }

  void tellAll() {
    wire::FromRobot& message = compose(kAll, RemoteType::req_all);
    message.set_step(seat->readings().time.step);
    encode(seat->readings(), *message.mutable_readings());
    for (std::size_t i = 0; i < seat->pictures.size(); ++i) {
      const Picture& picture = seat->pictures[i];
      encoded_pictures_[i] = picture.step;
      if (picture.step <= told_pictures_[i]) continue;
      message.mutable_readings()->mutable_measurements(static_cast<int>(i))->set_jpeg(picture.jpeg);
      message.set_picture_step(std::max(message.picture_step(), *picture.step));
    }
  }

  /// Sends the next message that is due, if the last is out.
  void sendNext() {
    if (is_gone_ || !isIdle()) return;
    const auto next = std::find(is_due_.begin(), is_due_.end(), true);
    if (next == is_due_.end()) return;
    const auto topic = static_cast<std::size_t>(next - is_due_.begin());
    draft().Swap(&due_[topic]);
    is_due_[topic] = asked_[topic] = false;
    if (topic == kState) wants_welcome_ = false;
    if (topic == kAll) told_pictures_ = encoded_pictures_;
    post();
  }

  Impl& port_;
  bool is_gone_ = false;
  bool wants_welcome_ = false;
  std::array<bool, kTopics> asked_{}, is_due_{};
  std::array<wire::FromRobot, kTopics> due_;
  std::vector<std::optional<std::uint64_t>> told_pictures_, encoded_pictures_;  ///< by sensor: the last one's step
};

RemotePort::Impl::Impl(const Options& the_options, const Run& the_run, const std::vector<RemoteControlRobot*>& robots)
    : options(the_options), run(the_run) {
  for (auto* robot : robots) {
    seats.push_back({robot, nullptr, {}, {}});
    seats.back().pictures.resize(robot->hardware().info().sensors->size());
  }
  open = openPort(options.listen, {options.tls, "--remote-port"}, {this});
}

RemotePort::Impl::~Impl() {
  sayGoodbye();  // a call that is never answered would be waited for
  open.server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
}

void RemotePort::Impl::Seat::keepPictures() {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto* image = std::get_if<Image>(&readings().measurements[i]);
    if (image && !image->jpeg.empty()) pictures[i] = {readings().time.step, image->jpeg};
  }
}

RawStream* RemotePort::Impl::Control(grpc::CallbackServerContext* context) {
  auto stream = std::make_shared<Stream>(*this, context);
  stream->begin();
  const std::lock_guard lock(mutex);
  if (is_over) {
    stream->end({grpc::StatusCode::UNAVAILABLE, "the run is over"});
  } else if (const auto status = options.access.check(*context, Right::look);
             !status.ok() && !options.access.check(*context, Right::drive).ok()) {
    stream->hangUp(status);
  } else {
    streams.push_back(stream);
  }
  return stream.get();
}

void RemotePort::Impl::init(Stream& stream, const RemoteOrder& order) {
  const auto seat =
      std::find_if(seats.begin(), seats.end(), [&](const Seat& s) { return s.robot->name() == order.robot; });
  if (seat == seats.end()) {
    std::vector<std::string> names;
    for (const auto& other : seats) names.push_back(other.robot->name());
    throw WireError("here is no robot " + inQuotes(order.robot) + " but " + listed(names) +
                        "; is its port right in the robot list?",
                    grpc::StatusCode::NOT_FOUND);
  }
  if (stream.seat && stream.seat != &*seat) throw WireError("a second INIT for another robot; connect anew for it");
  stream.name = order.driver;
  if (!stream.seat) stream.sitDown(*seat);
  const bool is_others = seat->driver && seat->driver != &stream;
  const grpc::Status may_drive = stream.may(Right::drive, order.robot);
  if (!may_drive.ok() && !stream.may(Right::look, order.robot).ok()) {
    throw WireError(may_drive.error_message(), may_drive.error_code());
  }
  // A token that may only look may look on, as may whoever finds the robot taken.
  if (order.only_watch || is_others || !may_drive.ok()) {
    letGo(stream);
    stream.tellState();
    return;
  }
  if (!seat->driver) options.log(stream.who() + " has the robot");
  seat->driver = &stream;
  seat->robot->take(stream.name.empty() ? stream.peer : stream.name, order.autonomous);
  tellStateOf(*seat);
}

void RemotePort::Impl::obey(Stream& stream, const RemoteOrder& order) {
  // Requests are no sign of life: a control may go on asking by itself when its driver has long gone.
  if (order.type == RemoteType::req_all) {
    stream.ask(kAll);
    return;
  }
  for (const auto& of : kOnRequest) {
    if (order.type != of.type) continue;
    stream.ask(of.topic);
    return;
  }
  if (!stream.hasRobot()) return;  // it was told whose it is
  if (order.type == RemoteType::init_ack) {
    stream.seat->robot->setAutonomous(order.autonomous);
    tellStateOf(*stream.seat);
  } else {
    stream.seat->robot->obey(order);
  }
}

/// It lets go of its robot, if it has one.
void RemotePort::Impl::letGo(Stream& stream) {
  if (!stream.hasRobot()) return;
  stream.seat->driver = nullptr;
  stream.seat->robot->release("its remote control has hung up");
  tellStateOf(*stream.seat);
}

void RemotePort::Impl::tellStateOf(const Seat& seat) {
  for (const auto& stream : streams) {
    if (stream->seat == &seat) stream->tellState();
  }
}

void RemotePort::Impl::tell() {
  const std::lock_guard lock(mutex);
  for (auto& seat : seats) {
    seat.keepPictures();
    const RemoteState state = seat.robot->state();
    if (newsIn(state) != newsIn(seat.told)) tellStateOf(seat);
    seat.told = state;
  }
  for (const auto& stream : streams) {
    if (stream->seat) stream->tellReadings();
  }
}

void RemotePort::Impl::sayGoodbye() {
  const std::lock_guard lock(mutex);
  is_over = true;
  for (const auto& stream : streams) stream->sayGoodbye();
}

RemotePort::RemotePort(const Options& options, const Run& run, const std::vector<RemoteControlRobot*>& robots)
    : impl_(std::make_unique<Impl>(options, run, robots)) {}
RemotePort::~RemotePort() = default;
int RemotePort::port() const { return impl_->open.number; }
void RemotePort::tell() { impl_->tell(); }
void RemotePort::sayGoodbye() { impl_->sayGoodbye(); }

}  // namespace robosim
