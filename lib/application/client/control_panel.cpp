#include "client/control_panel.h"

#include <string>

#include "net/wire_error.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

/// Below gRPC's limit of 4 MiB per message; a world may be larger.
constexpr std::size_t kPieceBytes = 1 << 20;

}  // namespace

ControlPanel::ControlPanel(const ConnectOptions& connect_options)
    : connect_options_(connect_options), stub_(v1::ControlPanel::NewStub(connect(connect_options))) {}

template <typename Method, typename Request>
v1::RunStatus ControlPanel::call(Method method, Request request) {
  ClientCall call(connect_options_, cancellation_);
  request.set_protocol(kProtocolVersion);
  v1::RunStatus status;
  check((stub_.get()->*method)(&call.context, request, &status));
  return status;
}

void ControlPanel::check(const grpc::Status& status) const {
  if (!status.ok()) throw ConnectionError(status, connect_options_);
}

v1::RunStatus ControlPanel::start() { return call(&v1::ControlPanel::Stub::Start, v1::StartRequest()); }
v1::RunStatus ControlPanel::pause() { return call(&v1::ControlPanel::Stub::Pause, v1::PauseRequest()); }
v1::RunStatus ControlPanel::stop() { return call(&v1::ControlPanel::Stub::Stop, v1::StopRequest()); }
v1::RunStatus ControlPanel::status() { return call(&v1::ControlPanel::Stub::GetStatus, v1::GetStatusRequest()); }

v1::RunStatus ControlPanel::step(std::uint64_t steps) {
  v1::StepRequest request;
  request.set_steps(steps);
  return call(&v1::ControlPanel::Stub::Step, request);
}

v1::RunStatus ControlPanel::setSpeed(double speed) {
  v1::SetSpeedRequest request;
  request.set_speed(speed);
  return call(&v1::ControlPanel::Stub::SetSpeed, request);
}

v1::RunStatus ControlPanel::setRecording(bool on) {
  v1::SetRecordingRequest request;
  request.set_on(on);
  return call(&v1::ControlPanel::Stub::SetRecording, request);
}

v1::RunStatus ControlPanel::supervise(const Change& change) {
  v1::SuperviseRequest request;
  request.set_change(changeText(change));
  return call(&v1::ControlPanel::Stub::Supervise, request);
}

v1::RunStatus ControlPanel::load(const WorldSource& world) {
  v1::WorldSource message;
  encode(world, message);
  const std::string bytes = message.SerializeAsString();
  ClientCall call(connect_options_, cancellation_);
  v1::RunStatus status;
  const auto stream = stub_->Load(&call.context, &status);
  v1::LoadRequest request;
  request.set_protocol(kProtocolVersion);
  for (std::size_t at = 0; at < bytes.size(); at += kPieceBytes) {
    request.set_piece(bytes.substr(at, kPieceBytes));
    if (!stream->Write(request)) break;  // Finish() returns the reason
  }
  stream->WritesDone();
  check(stream->Finish());
  return status;
}

void ControlPanel::watch(Seconds min_interval, const std::function<void(const v1::RunStatus&)>& on_status) {
  ClientCall call(connect_options_, cancellation_);
  v1::WatchRequest request;
  request.set_protocol(kProtocolVersion);
  request.set_min_interval_s(min_interval.count());
  const auto stream = stub_->Watch(&call.context, request);
  for (v1::RunStatus status; stream->Read(&status);) on_status(status);
  check(stream->Finish());
}

}  // namespace robosim
