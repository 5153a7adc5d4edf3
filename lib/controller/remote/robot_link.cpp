#include "remote/robot_link.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "net/client_stream.h"
#include "net/robot_wire.h"
#include "net/tls.h"
#include "robosim/v1/remote_control.grpc.pb.h"

namespace robosim {
namespace {

constexpr const char* kRunIsOver = "the run is over";

/// Why a call has ended, and how to fix it.
std::string describeProblem(const grpc::Status& status, const ConnectOptions& connect_options,
                            const std::string& robot) {
  if (status.ok()) return kRunIsOver;
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) {
    return connect_options.address + " is not the remote port of a robot; correct it in the robot list";
  }
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE) return status.error_message();
  const std::string why = connect_options.tls ? diagnoseTls(connect_options.address, connect_options.trusted_pem,
                                                            connect_options.connect_limit)
                                              : "";
  if (!why.empty()) return "no TLS with " + connect_options.address + ": " + why;
  return "no robot answers at " + connect_options.address + "; is 'robosim robot " + robot +
         " --remote-port …' running?";
}

}  // namespace

/// The link's thread makes the calls. The mutex guards the members below it.
struct RobotLink::Impl {
  using Stream = ClientStream<v1::ControlRequest, v1::ControlResponse>;

  Impl(std::string the_robot, ConnectOptions options, std::function<void()> news_callback);
  ~Impl();

  void makeCalls();  ///< on the thread
  grpc::Status call(std::string& error);
  /// @name With the mutex locked
  ///@{
  void sendNext();  ///< unless a message is being written
  bool takeNext();
  void discardSuperseded(OrderRule newer);
  void processMessage();
  void processUpdate(const v1::ControlResponse::AllReadings& all);
  void processAnswer(const v1::ControlResponse::Reading& reading);
  ///@}

  const std::string robot;
  const ConnectOptions connect_options;
  const std::function<void()> on_news;
  const std::unique_ptr<v1::RemoteControl::Stub> stub;
  Stream stream;
  v1::ControlRequest out;
  v1::ControlResponse in;

  std::mutex mutex;
  std::condition_variable call_requested;
  bool is_calling = false;    ///< there is a call, or it is requested
  bool is_connected = false;  ///< messages can be sent
  bool is_over = false;
  RobotNews news;
  bool is_live = false;
  /// @name Messages to send, in this order
  ///@{
  std::optional<v1::ControlRequest> init;
  bool init_is_due = false;
  std::array<std::optional<v1::ControlRequest>, kOrders.size()> waiting;  ///< the newest order of each type
  bool request_all_is_due = false;
  ///@}

  std::thread thread;
};

RobotLink::Impl::Impl(std::string the_robot, ConnectOptions options, std::function<void()> news_callback)
    : robot(std::move(the_robot)),
      connect_options(std::move(options)),
      on_news(std::move(news_callback)),
      stub(v1::RemoteControl::NewStub(robosim::connect(connect_options))),
      stream(connect_options, [this](auto... arguments) { return stub->AsyncControl(arguments...); }) {
  stream.setAdaptivePolling(false);
  news.problem = "not connected yet";
  thread = std::thread([this] { makeCalls(); });
}

RobotLink::Impl::~Impl() {
  {
    const std::lock_guard lock(mutex);
    is_over = true;
  }
  stream.cancel();
  call_requested.notify_one();
  thread.join();
}

/// Moves the next message to send to `out`. @return false if there is none
bool RobotLink::Impl::takeNext() {
  if (init && std::exchange(init_is_due, false)) {
    out = *init;
    return true;
  }
  if (!news.is_up) return false;  // not before the welcome
  const auto next = std::find_if(waiting.begin(), waiting.end(), [](const auto& order) { return order.has_value(); });
  if (next != waiting.end()) {
    out = *std::exchange(*next, std::nullopt);
    return true;
  }
  if (!std::exchange(request_all_is_due, false)) return false;
  out.mutable_req_all();
  return true;
}

void RobotLink::Impl::discardSuperseded(OrderRule newer) {
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    if (supersedes(newer, kOrders[i].rule)) waiting[i].reset();
  }
}

void RobotLink::Impl::makeCalls() {
  for (std::unique_lock lock(mutex);;) {
    call_requested.wait(lock, [this] { return is_calling || is_over; });
    if (is_over) return;
    lock.unlock();
    std::string problem;
    const grpc::Status status = call(problem);
    if (problem.empty()) problem = describeProblem(status, connect_options, robot);
    lock.lock();
    is_calling = news.is_up = false;
    // After the end of its run nothing answers until the next one.
    news.is_over = status.ok() || (news.is_over && status.error_code() == grpc::StatusCode::UNAVAILABLE);
    news.problem = news.is_over ? kRunIsOver : problem;
    news.was_refused = status.error_code() == grpc::StatusCode::NOT_FOUND ||
                       status.error_code() == grpc::StatusCode::UNAUTHENTICATED ||
                       status.error_code() == grpc::StatusCode::PERMISSION_DENIED ||
                       status.error_code() == grpc::StatusCode::FAILED_PRECONDITION;
    waiting = {};
    request_all_is_due = false;
    lock.unlock();
    on_news();
    lock.lock();
  }
}

/// @param error receives why a message was invalid, which ends the call
grpc::Status RobotLink::Impl::call(std::string& error) {
  stream.open();
  std::unique_lock lock(mutex);
  is_connected = true;
  while (error.empty()) {
    sendNext();
    lock.unlock();
    const auto event = stream.next(in);
    lock.lock();
    if (event == Stream::Event::ended) break;
    if (event == Stream::Event::written) continue;
    try {
      processMessage();
    } catch (const WireError& invalid) {
      error = connect_options.address + " sent an invalid message: " + invalid.what();
    }
    lock.unlock();
    on_news();
    lock.lock();
  }
  is_connected = false;
  lock.unlock();
  if (error.empty()) return stream.finish();
  stream.close();
  return grpc::Status::CANCELLED;
}

void RobotLink::Impl::sendNext() {
  if (!is_connected || stream.isWriting()) return;
  if (takeNext()) stream.write(out);
}

void RobotLink::Impl::processMessage() {
  if (in.has_welcome()) {
    const RobotsWelcome welcome = decode(in.welcome());
    if (welcome.robots.size() != 1) throw WireError("a welcome for a number of robots other than one");
    news.info = std::make_shared<const RobotInfo>(welcome.robots[0].info);
    news.world = welcome.world;
    news.period_s = welcome.period_s;
    news.update.reset();
    news.picture.reset();
    news.answers = {};
    news.is_up = true;
    news.is_over = false;
    news.problem.clear();
    request_all_is_due = is_live;
  }
  if (!news.is_up) throw WireError("the first message is not a welcome");
  validate(in.state());
  news.state = in.state();
  if (in.has_all()) processUpdate(in.all());
  if (in.has_reading()) processAnswer(in.reading());
}

void RobotLink::Impl::processUpdate(const v1::ControlResponse::AllReadings& all) {
  auto update = std::make_shared<RobotUpdate>();
  update->readings = blankReadings(*news.info->sensors);
  update->readings.time = {all.step(), news.period_s};
  decode(all.readings(), news.info->name, update->readings);
  update->readings.winner = news.state.winner();
  update->state = news.state;
  bool is_first_camera = true;
  for (std::size_t i = 0; i < update->readings.measurements.size(); ++i) {
    auto* image = std::get_if<Image>(&update->readings.measurements[i]);
    if (!image) continue;
    if (std::exchange(is_first_camera, false) && !image->jpeg.empty()) {
      const std::uint64_t step = all.readings().measurements(static_cast<int>(i)).step();
      news.picture = std::make_shared<const RobotPicture>(RobotPicture{step, std::move(image->jpeg)});
    }
    *image = {};
  }
  news.update = std::move(update);
  request_all_is_due = is_live;
}

void RobotLink::Impl::processAnswer(const v1::ControlResponse::Reading& reading) {
  std::size_t index = 0;
  while (index < kReadings && reading.kind() != nameOf(readingRow(index).sensor)) ++index;
  if (index == kReadings)
    throw WireError("a reading of the kind " + inQuotes(reading.kind()) + ", which was not requested");
  auto answer = std::make_shared<RobotAnswer>();
  answer->step = reading.step();
  answer->has_sensor = reading.has_sensor();
  if (reading.has_sensor()) {
    if (reading.sensor() >= news.info->sensors->size())
      throw WireError("a reading of a sensor that the robot does not have");
    answer->sensor = reading.sensor();
    answer->measurement = blankReadings(*news.info->sensors).measurements[answer->sensor];
    decode(reading.measurement(), answer->measurement);
  }
  news.answers[index] = std::move(answer);
}

RobotLink::RobotLink(std::string robot, ConnectOptions connect_options, std::function<void()> on_news)
    : impl_(std::make_unique<Impl>(std::move(robot), std::move(connect_options), std::move(on_news))) {}
RobotLink::~RobotLink() = default;

void RobotLink::connect() {
  const std::lock_guard lock(impl_->mutex);
  if (std::exchange(impl_->is_calling, true)) return;
  impl_->init_is_due = impl_->init.has_value();
  impl_->call_requested.notify_one();
}

bool RobotLink::isCalling() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->is_calling;
}

void RobotLink::claim(const std::string& driver, bool autonomous) {
  const std::lock_guard lock(impl_->mutex);
  auto& init = *impl_->init.emplace().mutable_init();
  init.set_protocol(kProtocolVersion);
  init.set_robot(impl_->robot);
  init.set_driver(driver);
  init.set_autonomous(autonomous);
  impl_->init_is_due = true;
  impl_->waiting[indexOf(OrderType::set_mode)].reset();
  impl_->discardSuperseded(OrderRule::mode);
  impl_->sendNext();
}

void RobotLink::send(const v1::ControlRequest& order) {
  const OrderRow& row = rowOf(typeOf(order));
  const std::lock_guard lock(impl_->mutex);
  // A disconnected robot receives the switch with its next INIT. A stop of the driver ends the autonomous mode.
  if (row.rule == OrderRule::mode && impl_->init) {
    impl_->init->mutable_init()->set_autonomous(order.set_mode().autonomous());
  }
  const bool is_drivers_stop = row.rule == OrderRule::stop && whyOf(order).empty();
  if (is_drivers_stop && impl_->init) impl_->init->mutable_init()->set_autonomous(false);
  if (!impl_->news.is_up) return;
  impl_->discardSuperseded(row.rule);
  auto& waiting = impl_->waiting[indexOf(row.type)];
  waiting = waiting && row.rule == OrderRule::set ? mergeDrive(*waiting, order) : order;
  impl_->sendNext();
}

void RobotLink::setLive(bool live) {
  const std::lock_guard lock(impl_->mutex);
  if (std::exchange(impl_->is_live, live) == live || !live || !impl_->news.is_up) return;
  impl_->request_all_is_due = true;
  impl_->sendNext();
}

RobotNews RobotLink::news() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->news;
}

}  // namespace robosim
