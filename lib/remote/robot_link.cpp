#include "remote/robot_link.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "net/listen.h"
#include "net/remote.grpc.pb.h"
#include "net/robot_wire.h"
#include "net/tls.h"

namespace robosim {
namespace {

std::string told(const grpc::Status& status, const DialOptions& dialled, const std::string& robot) {
  if (status.ok()) return "the run is over";
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) {
    return "at " + dialled.address + " is no robot's remote port; is it right in the robot list?";
  }
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE) return status.error_message();
  const std::string why = dialled.tls ? whyTlsFails(dialled.address, dialled.trusted_pem) : "";
  if (!why.empty()) return "no TLS with " + dialled.address + ": " + why;
  return "no robot answers at " + dialled.address + "; is 'robosim robot " + robot + " --remote-port …' running?";
}

}  // namespace

/// What calls and the link's owner share. Touched with the mutex held.
struct RobotLink::Shared {
  std::string robot;
  DialOptions dialled;
  std::function<void()> ring;
  std::unique_ptr<wire::RemoteControl::Stub> stub;

  std::mutex mutex;
  std::condition_variable call_has_ended;
  Call* call = nullptr;  ///< null when there is none
  int calls = 0;         ///< that have begun and are not deleted yet
  RobotNews news;
  bool is_live = false;
  /// @name What is to be sent, in this order
  ///@{
  std::optional<RemoteOrder> init;
  bool init_is_due = false;
  std::optional<RemoteOrder> switching;  ///< INIT_ACK
  std::optional<RemoteOrder> steering;   ///< the newest
  bool asks_for_win = false;
  std::array<bool, 3> asks_for{};  ///< heat, laser, sonar
  bool asks_for_all = false;
  bool is_alive = false;
  ///@}

  /// The next message to send; nullopt when there is nothing to say.
  std::optional<RemoteOrder> next();
  void forgetOrders();
};

std::optional<RemoteOrder> RobotLink::Shared::next() {
  if (init && init_is_due) {
    init_is_due = false;
    return init;
  }
  if (!news.is_up) return std::nullopt;  // not before it has answered
  if (switching) return std::exchange(switching, std::nullopt);
  if (steering) return std::exchange(steering, std::nullopt);
  if (std::exchange(asks_for_win, false)) return RemoteOrder{.type = RemoteType::check_win};
  for (std::size_t i = 0; i < asks_for.size(); ++i) {
    const auto type = static_cast<RemoteType>(static_cast<std::size_t>(RemoteType::req_heat) + i);
    if (std::exchange(asks_for[i], false)) return RemoteOrder{.type = type};
  }
  if (std::exchange(asks_for_all, false)) return RemoteOrder{.type = RemoteType::req_all};
  if (std::exchange(is_alive, false)) return RemoteOrder{.type = RemoteType::alive};
  return std::nullopt;
}

void RobotLink::Shared::forgetOrders() {
  switching.reset();
  steering.reset();
  asks_for_win = asks_for_all = is_alive = false;
  asks_for.fill(false);
}

/// One call; gRPC runs it and calls the On…() from threads of its own. It deletes itself when it is over.
class RobotLink::Call final : public grpc::ClientBidiReactor<wire::ToRobot, wire::FromRobot> {
 public:
  explicit Call(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {
    showToken(context_, shared_->dialled);
    shared_->stub->async()->Control(&context_, this);
    // Writes begin outside of the On…() too, and the call must not end under them.
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
      if (ok && !take()) ok = false;
      if (ok) {
        StartRead(&in_);
        sendNext();
      } else {
        has_ended_ = true;
      }
    }
    shared_->ring();
    if (ok) return;
    cancel();
    RemoveHold();
  }

  void OnDone(const grpc::Status& status) override {
    const auto shared = shared_;
    const std::string problem = complaint_.empty() ? told(status, shared->dialled, shared->robot) : complaint_;
    {
      const std::lock_guard lock(shared->mutex);
      shared->call = nullptr;
      shared->news.is_up = false;
      shared->news.problem = problem;
      shared->news.was_refused = status.error_code() == grpc::StatusCode::NOT_FOUND ||
                                 status.error_code() == grpc::StatusCode::UNAUTHENTICATED ||
                                 status.error_code() == grpc::StatusCode::PERMISSION_DENIED ||
                                 status.error_code() == grpc::StatusCode::FAILED_PRECONDITION;
      shared->forgetOrders();
    }
    delete this;  // not before nobody finds it any more
    shared->ring();
    const std::lock_guard lock(shared->mutex);
    --shared->calls;
    shared->call_has_ended.notify_all();
  }

  /// Takes over what came. @return false for nonsense, which ends the call
  /// @pre holds the mutex
  bool take() {
    try {
      takeMessage();
      return true;
    } catch (const WireError& error) {
      complaint_ = "what " + shared_->dialled.address + " sends makes no sense: " + error.what();
      return false;
    }
  }

  void takeMessage() {
    RobotNews& news = shared_->news;
    if (in_.has_welcome()) {
      const RobotsWelcome welcome = decode(in_.welcome());
      if (welcome.seats.size() != 1) throw WireError("a welcome for another number of robots than one");
      news.info = std::make_shared<const RobotInfo>(welcome.seats[0].info);
      news.world = welcome.world;
      news.period_s = welcome.period_s;
      news.update.reset();
      news.picture.reset();
      news.answers = {};
      news.is_up = true;
      news.problem.clear();
      shared_->asks_for_all = shared_->is_live;
    }
    if (!news.is_up) throw WireError("the first message is no welcome");
    news.state = decode(in_.state());
    if (in_.type() == wire::REQ_ALL) takeUpdate();
    if (in_.type() >= wire::REQ_HEAT && in_.type() <= wire::REQ_SONAR) takeAnswer();
  }

  void takeUpdate() {
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
    shared_->asks_for_all = shared_->is_live;
  }

  void takeAnswer() {
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
  wire::ToRobot out_;
  wire::FromRobot in_;
  std::string complaint_;
  bool is_writing_ = false;
  bool has_ended_ = false;
};

RobotLink::RobotLink(std::string robot, DialOptions dialled, std::function<void()> ring)
    : dialled_(std::move(dialled)), shared_(std::make_shared<Shared>()) {
  shared_->robot = std::move(robot);
  shared_->dialled = dialled_;
  shared_->ring = std::move(ring);
  shared_->news.problem = "not called yet";
  shared_->stub = wire::RemoteControl::NewStub(dial(dialled_));
}

RobotLink::~RobotLink() {
  std::unique_lock lock(shared_->mutex);
  if (shared_->call) shared_->call->cancel();
  shared_->call_has_ended.wait(lock, [&] { return shared_->calls == 0; });
  // Here, for a call that has just ended may hold what is shared a little longer, and a connection must not be closed
  // by gRPC's own thread, which would wait for itself.
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
  if (shared_->call) shared_->call->sendNext();
}

void RobotLink::send(const RemoteOrder& order) {
  const std::lock_guard lock(shared_->mutex);
  // A robot that is down learns with its next INIT who is to drive it.
  if (order.type == RemoteType::init_ack && shared_->init) shared_->init->autonomous = order.autonomous;
  if (!shared_->news.is_up || !shared_->call) return;
  switch (order.type) {
    case RemoteType::init:
      return;  // claim() says it
    case RemoteType::init_ack:
      shared_->switching = order;
      shared_->steering.reset();
      break;
    case RemoteType::check_win:
      shared_->asks_for_win = true;
      break;
    case RemoteType::req_heat:
    case RemoteType::req_laser:
    case RemoteType::req_sonar:
      shared_->asks_for[static_cast<std::size_t>(order.type) - static_cast<std::size_t>(RemoteType::req_heat)] = true;
      break;
    case RemoteType::req_all:
      shared_->asks_for_all = true;
      break;
    case RemoteType::alive:
      shared_->is_alive = true;
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
  shared_->asks_for_all = true;
  shared_->call->sendNext();
}

RobotNews RobotLink::news() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->news;
}

}  // namespace robosim
