#include "client/control_panel.h"

#include <string>
#include <thread>

#include "net/wire_error.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

/// Below gRPC's limit of 4 MiB per message; a world may be larger.
constexpr std::size_t kPieceBytes = 1 << 20;

}  // namespace

/// The client context of one call, registered so that leave() can cancel it.
class ControlPanel::Call {
 public:
  explicit Call(ControlPanel& panel) : panel_(panel) {
    attachToken(context, panel.connect_options_);
    const std::lock_guard lock(panel_.mutex_);
    panel_.in_flight_ = &context;
    if (panel_.has_left_) context.TryCancel();
  }
  ~Call() {
    const std::lock_guard lock(panel_.mutex_);
    panel_.in_flight_ = nullptr;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  grpc::ClientContext context;

 private:
  ControlPanel& panel_;
};

ControlPanel::ControlPanel(const ConnectOptions& connect_options)
    : connect_options_(connect_options), stub_(wire::ControlPanel::NewStub(connect(connect_options))) {}

template <typename Method, typename Request>
wire::RunStatus ControlPanel::call(Method method, Request request) {
  Call call(*this);
  request.set_protocol(kProtocolVersion);
  wire::RunStatus status;
  check((stub_.get()->*method)(&call.context, request, &status));
  return status;
}

void ControlPanel::leave() {
  const std::lock_guard lock(mutex_);
  has_left_ = true;
  if (in_flight_) in_flight_->TryCancel();
}

void ControlPanel::check(const grpc::Status& status) const {
  if (!status.ok()) throw ConnectionError(status, connect_options_);
}

wire::RunStatus ControlPanel::start() { return call(&wire::ControlPanel::Stub::Start, wire::PanelRequest()); }
wire::RunStatus ControlPanel::pause() { return call(&wire::ControlPanel::Stub::Pause, wire::PanelRequest()); }
wire::RunStatus ControlPanel::stop() { return call(&wire::ControlPanel::Stub::Stop, wire::PanelRequest()); }
wire::RunStatus ControlPanel::status() { return call(&wire::ControlPanel::Stub::Status, wire::PanelRequest()); }

wire::RunStatus ControlPanel::step(std::uint64_t steps) {
  wire::StepRequest request;
  request.set_steps(steps);
  return call(&wire::ControlPanel::Stub::Step, request);
}

wire::RunStatus ControlPanel::setSpeed(double speed) {
  wire::SpeedRequest request;
  request.set_speed(speed);
  return call(&wire::ControlPanel::Stub::SetSpeed, request);
}

wire::RunStatus ControlPanel::load(const WorldSource& world) {
  wire::WorldSource message;
  encode(world, message);
  const std::string bytes = message.SerializeAsString();
  Call call(*this);
  const auto stream = stub_->Load(&call.context);
  wire::WorldPiece piece;
  piece.set_protocol(kProtocolVersion);
  for (std::size_t at = 0; at < bytes.size(); at += kPieceBytes) {
    piece.set_piece(bytes.substr(at, kPieceBytes));
    if (!stream->Write(piece)) break;  // Finish() returns the reason
  }
  stream->WritesDone();
  wire::RunStatus status;
  while (stream->Read(&status)) {
  }
  check(stream->Finish());
  return status;
}

void ControlPanel::watch(std::chrono::duration<double> period,
                         const std::function<void(const wire::RunStatus&)>& on_status) {
  Call call(*this);
  const auto stream = stub_->Watch(&call.context);
  wire::PanelRequest request;
  request.set_protocol(kProtocolVersion);
  wire::RunStatus status;
  while (stream->Write(request) && stream->Read(&status)) {
    on_status(status);
    std::this_thread::sleep_for(period);
  }
  while (stream->Read(&status)) on_status(status);  // the final status
  check(stream->Finish());
}

}  // namespace robosim
