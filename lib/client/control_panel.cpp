#include "client/control_panel.h"

#include <string>
#include <thread>

#include "net/client_stream.h"
#include "net/wire_error.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

/// Below gRPC's limit of 4 MiB per message; a world may be larger.
constexpr std::size_t kPieceBytes = 1 << 20;

}  // namespace

ControlPanel::ControlPanel(const ConnectOptions& connect_options)
    : connect_options_(connect_options), stub_(wire::ControlPanel::NewStub(connect(connect_options))) {}

template <typename Method, typename Request>
wire::RunStatus ControlPanel::call(Method method, Request request) {
  ClientCall call(connect_options_, cancellation_);
  request.set_protocol(kProtocolVersion);
  wire::RunStatus status;
  check((stub_.get()->*method)(&call.context, request, &status));
  return status;
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
  ClientStream<wire::WorldPiece, wire::RunStatus> stream(
      connect_options_, cancellation_, [this](auto... arguments) { return stub_->AsyncLoad(arguments...); });
  stream.open();
  wire::WorldPiece piece;
  piece.set_protocol(kProtocolVersion);
  for (std::size_t at = 0; at < bytes.size(); at += kPieceBytes) {
    piece.set_piece(bytes.substr(at, kPieceBytes));
    if (!stream.write(piece)) break;  // finish() returns the reason
  }
  stream.writesDone();
  wire::RunStatus status;
  while (stream.read(status)) {
  }
  stream.finishOrThrow();
  return status;
}

void ControlPanel::watch(std::chrono::duration<double> period,
                         const std::function<void(const wire::RunStatus&)>& on_status) {
  ClientStream<wire::PanelRequest, wire::RunStatus> stream(
      connect_options_, cancellation_, [this](auto... arguments) { return stub_->AsyncWatch(arguments...); });
  stream.open();
  wire::PanelRequest request;
  request.set_protocol(kProtocolVersion);
  wire::RunStatus status;
  while (stream.write(request) && stream.read(status)) {
    on_status(status);
    std::this_thread::sleep_for(period);
  }
  while (stream.read(status)) on_status(status);  // the final status
  stream.finishOrThrow();
}

}  // namespace robosim
