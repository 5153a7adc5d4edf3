#include "remote/robot_link.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "net/listen.h"
#include "net/remote.grpc.pb.h"
#include "net/robot_wire.h"
#include "net/tls.h"
#include "remote/drive_order.h"

namespace robosim {
namespace {

/// Why a call has ended, and how to fix it.
std::string problemOf(const grpc::Status& status, const ConnectOptions& connect_options, const std::string& robot) {
  if (status.ok()) return "the run is over";
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

/// State shared by calls and the link's owner. Guarded by the mutex.
struct RobotLink::Shared {
  std::string robot;
  ConnectOptions connect_options;
  std::function<void()> on_news;
  std::unique_ptr<wire::RemoteControl::Stub> stub;

  std::mutex mutex;
  std::condition_variable call_has_ended;
  Call* call = nullptr;  ///< null when there is none
  int calls = 0;         ///< number of calls that were started and are not deleted yet
  RobotNews news;
  bool is_live = false;
  /// @name Messages to send, in this order
  ///@{
  std::optional<RemoteOrder> init;
  bool init_is_due = false;
  std::optional<RemoteOrder> switching;  ///< INIT_ACK
  std::optional<RemoteOrder> stop;       ///< never superseded by a later order
  std::optional<RemoteOrder> driving;    ///< DRIVE: the newest speed, turn and pan
  std::optional<RemoteOrder> steering;   ///< the newest other order that steers
  bool check_win_is_due = false;
  std::array<bool, 3> request_is_due{};  ///< heat, laser, sonar
  bool request_all_is_due = false;
  bool alive_is_due = false;
  ///@}

  /// The next message to send; nullopt for none.
  std::optional<RemoteOrder> next();
  void discardSteering();
  void discardOrders();
};

std::optional<RemoteOrder> RobotLink::Shared::next() {
  if (init && init_is_due) {
    init_is_due = false;
    return init;
  }
  if (!news.is_up) return std::nullopt;  // not before the welcome
  if (switching) return std::exchange(switching, std::nullopt);
  if (stop) return std::exchange(stop, std::nullopt);
  if (driving) return std::exchange(driving, std::nullopt);
  if (steering) return std::exchange(steering, std::nullopt);
  if (std::exchange(check_win_is_due, false)) return RemoteOrder{.type = RemoteType::check_win};
  for (std::size_t i = 0; i < request_is_due.size(); ++i) {
    const auto type = static_cast<RemoteType>(static_cast<std::size_t>(RemoteType::req_heat) + i);
    if (std::exchange(request_is_due[i], false)) return RemoteOrder{.type = type};
  }
  if (std::exchange(request_all_is_due, false)) return RemoteOrder{.type = RemoteType::req_all};
  if (std::exchange(alive_is_due, false)) return RemoteOrder{.type = RemoteType::alive};
  return std::nullopt;
}

void RobotLink::Shared::discardSteering() {
  stop.reset();
  driving.reset();
  steering.reset();
}

void RobotLink::Shared::discardOrders() {
  switching.reset();
  discardSteering();
  check_win_is_due = request_all_is_due = alive_is_due = false;
  request_is_due.fill(false);
}

/// One call. gRPC calls the On…() from its own threads. Deletes itself in OnDone().
class RobotLink::Call final : public grpc::ClientBidiReactor<wire::ControlRequest, wire::ControlResponse> {
 public:
  explicit Call(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {
    attachToken(context_, shared_->connect_options);
    shared_->stub->async()->Control(&context_, this);
    // Writes are also started outside of the On…(), during which the call must not end.
    AddHold();
    StartRead(&in_);
    StartCall();
  }

  /// @pre holds the mutex
  void sendNext() {
    if (is_writing_ || has_ended_) return;
    const auto order = shared_->next();
    if (!order) return;
    encode(*order, out_);
    is_writing_ = true;
    StartWrite(&out_);
  }
  void cancel() { context_.TryCancel(); }

 private:
  void OnWriteDone(bool) override {
    const std::lock_guard lock(shared_->mutex);
    is_writing_ = false;
    sendNext();
  }

  void OnReadDone(bool ok) override {
    {
      const std::lock_guard lock(shared_->mutex);
      if (ok && !receive()) ok = false;
      if (ok) {
        StartRead(&in_);
        sendNext();
      } else {
        has_ended_ = true;
      }
    }
    shared_->on_news();
    if (ok) return;
    cancel();
    RemoveHold();
  }

  void OnDone(const grpc::Status& status) override {
    const auto shared = shared_;
    const std::string problem = error_.empty() ? problemOf(status, shared->connect_options, shared->robot) : error_;
    {
      const std::lock_guard lock(shared->mutex);
      shared->call = nullptr;
      shared->news.is_up = false;
      shared->news.problem = problem;
      shared->news.was_refused = status.error_code() == grpc::StatusCode::NOT_FOUND ||
                                 status.error_code() == grpc::StatusCode::UNAUTHENTICATED ||
                                 status.error_code() == grpc::StatusCode::PERMISSION_DENIED ||
                                 status.error_code() == grpc::StatusCode::FAILED_PRECONDITION;
      shared->discardOrders();
    }
    delete this;  // no other thread refers to it any more
    shared->on_news();
    const std::lock_guard lock(shared->mutex);
    --shared->calls;
    shared->call_has_ended.notify_all();
  }

  /// Processes a message. @return false for an invalid one, which ends the call
  /// @pre holds the mutex
  bool receive() {
    try {
      processMessage();
      return true;
    } catch (const WireError& error) {
      error_ = shared_->connect_options.address + " sent an invalid message: " + error.what();
      return false;
    }
  }

  void processMessage() {
    RobotNews& news = shared_->news;
    if (in_.has_welcome()) {
      const RobotsWelcome welcome = decode(in_.welcome());
      if (welcome.robots.size() != 1) throw WireError("a welcome for a number of robots other than one");
      news.info = std::make_shared<const RobotInfo>(welcome.robots[0].info);
      news.world = welcome.world;
      news.period_s = welcome.period_s;
      news.update.reset();
      news.picture.reset();
      news.answers = {};
      news.is_up = true;
      news.problem.clear();
      shared_->request_all_is_due = shared_->is_live;
    }
    if (!news.is_up) throw WireError("the first message is not a welcome");
    news.state = decode(in_.state());
    if (in_.type() == wire::REQ_ALL) processUpdate();
    if (in_.type() >= wire::REQ_HEAT && in_.type() <= wire::REQ_SONAR) processAnswer();
  }

  void processUpdate() {
    RobotNews& news = shared_->news;
    auto update = std::make_shared<RobotUpdate>();
    update->readings = blankReadings(*news.info->sensors);
    decode(in_.readings(), news.info->name, update->readings);
    update->readings.time = {in_.step(), news.period_s};
    update->readings.winner = news.state.winner;
    update->state = news.state;
    bool is_first_camera = true;
    for (auto& measurement : update->readings.measurements) {
      auto* image = std::get_if<Image>(&measurement);
      if (!image) continue;
      if (std::exchange(is_first_camera, false) && !image->jpeg.empty()) {
        news.picture = std::make_shared<const RobotPicture>(RobotPicture{in_.picture_step(), std::move(image->jpeg)});
      }
      image->jpeg.clear();
    }
    news.update = std::move(update);
    shared_->request_all_is_due = shared_->is_live;
  }

  void processAnswer() {
    RobotNews& news = shared_->news;
    auto answer = std::make_shared<RobotAnswer>();
    answer->step = in_.step();
    answer->has_sensor = in_.has_sensor();
    if (in_.has_sensor()) {
      if (in_.sensor() >= news.info->sensors->size())
        throw WireError("a reading of a sensor that the robot does not have");
      answer->sensor = in_.sensor();
      answer->measurement = blankReadings(*news.info->sensors).measurements[answer->sensor];
      decode(in_.measurement(), answer->measurement);
    }
    news.answers[static_cast<std::size_t>(in_.type() - wire::REQ_HEAT)] = std::move(answer);
  }

  std::shared_ptr<Shared> shared_;
  grpc::ClientContext context_;
  wire::ControlRequest out_;
  wire::ControlResponse in_;
  std::string error_;
  bool is_writing_ = false;
  bool has_ended_ = false;
};

RobotLink::RobotLink(std::string robot, ConnectOptions connect_options, std::function<void()> on_news)
    : connect_options_(std::move(connect_options)), shared_(std::make_shared<Shared>()) {
  shared_->robot = std::move(robot);
  shared_->connect_options = connect_options_;
  shared_->on_news = std::move(on_news);
  shared_->news.problem = "not connected yet";
  shared_->stub = wire::RemoteControl::NewStub(robosim::connect(connect_options_));
}

RobotLink::~RobotLink() {
  std::unique_lock lock(shared_->mutex);
  if (shared_->call) shared_->call->cancel();
  shared_->call_has_ended.wait(lock, [&] { return shared_->calls == 0; });
  // Released here: an ended call may hold the shared state slightly longer, and gRPC's own thread must not close a
  // connection, since it would wait for itself.
  const auto stub = std::move(shared_->stub);
  lock.unlock();
}

void RobotLink::connect() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->call) return;
  shared_->init_is_due = shared_->init.has_value();
  shared_->call = new Call(shared_);
  ++shared_->calls;
  shared_->call->sendNext();
}

bool RobotLink::isCalling() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->call != nullptr;
}

void RobotLink::claim(const std::string& driver, bool autonomous) {
  const std::lock_guard lock(shared_->mutex);
  shared_->init =
      RemoteOrder{.type = RemoteType::init, .robot = shared_->robot, .driver = driver, .autonomous = autonomous};
  shared_->init_is_due = true;
  shared_->switching.reset();
  shared_->discardSteering();
  if (shared_->call) shared_->call->sendNext();
}

void RobotLink::send(const RemoteOrder& order) {
  const std::lock_guard lock(shared_->mutex);
  // A disconnected robot receives the switch with its next INIT.
  if (order.type == RemoteType::init_ack && shared_->init) shared_->init->autonomous = order.autonomous;
  if (!shared_->news.is_up || !shared_->call) return;
  switch (order.type) {
    case RemoteType::init:
      return;  // sent by claim()
    case RemoteType::init_ack:
      shared_->switching = order;
      shared_->discardSteering();
      break;
    case RemoteType::check_win:
      shared_->check_win_is_due = true;
      break;
    case RemoteType::req_heat:
    case RemoteType::req_laser:
    case RemoteType::req_sonar:
      shared_->request_is_due[static_cast<std::size_t>(order.type) - static_cast<std::size_t>(RemoteType::req_heat)] =
          true;
      break;
    case RemoteType::req_all:
      shared_->request_all_is_due = true;
      break;
    case RemoteType::alive:
      shared_->alive_is_due = true;
      break;
    case RemoteType::stop:
      shared_->discardSteering();
      shared_->stop = order;
      break;
    case RemoteType::drive:
      shared_->driving = shared_->driving ? mergeDrive(*shared_->driving, order) : order;
      shared_->steering.reset();
      break;
    default:
      shared_->steering = order;
      break;
  }
  shared_->call->sendNext();
}

void RobotLink::setLive(bool live) {
  const std::lock_guard lock(shared_->mutex);
  if (std::exchange(shared_->is_live, live) == live || !live || !shared_->news.is_up || !shared_->call) return;
  shared_->request_all_is_due = true;
  shared_->call->sendNext();
}

RobotNews RobotLink::news() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->news;
}

}  // namespace robosim
