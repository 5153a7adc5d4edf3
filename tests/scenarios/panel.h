#pragma once
#include <string>

#include <gtest/gtest.h>

#include "net/control_panel.grpc.pb.h"
#include "net/wire_error.h"
#include "server/world_wire.h"
#include "tests/scenarios/served_world.h"

namespace robosim {

/// A control panel as a test uses it: each call must go well, or is asked how it went.
class Panel {
 public:
  explicit Panel(const ServedWorld& world) : stub_(wire::ControlPanel::NewStub(dial(world.dialOptions()))) {}

  wire::RunStatus start() { return good(&wire::ControlPanel::Stub::Start, wire::PanelRequest()); }
  wire::RunStatus pause() { return good(&wire::ControlPanel::Stub::Pause, wire::PanelRequest()); }
  wire::RunStatus stop() { return good(&wire::ControlPanel::Stub::Stop, wire::PanelRequest()); }
  wire::RunStatus status() { return good(&wire::ControlPanel::Stub::Status, wire::PanelRequest()); }
  wire::RunStatus step(std::uint64_t steps) {
    wire::StepRequest request;
    request.set_steps(steps);
    return good(&wire::ControlPanel::Stub::Step, request);
  }
  wire::RunStatus load(const std::string& file) {
    wire::WorldSource source;
    encode(readWorldSource(ROBOSIM_SOURCE_DIR "/" + file), source);
    wire::RunStatus status;
    const grpc::Status how = loadBytes(source.SerializeAsString(), 10'000, status);
    EXPECT_TRUE(how.ok()) << how.error_message();
    return status;
  }

  /// Calls, say, &Stub::Step with a request as it is.
  template <typename Method, typename Request>
  grpc::Status call(Method method, const Request& request, wire::RunStatus& status) {
    grpc::ClientContext context;
    return (stub_.get()->*method)(&context, request, &status);
  }
  /// Sends these bytes in pieces.
  grpc::Status loadBytes(const std::string& bytes, std::size_t piece_bytes, wire::RunStatus& status) {
    grpc::ClientContext context;
    const auto writer = stub_->Load(&context, &status);
    for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
      wire::WorldPiece piece;
      piece.set_protocol(kProtocolVersion);
      piece.set_piece(bytes.substr(at, piece_bytes));
      if (!writer->Write(piece)) break;
    }
    writer->WritesDone();
    return writer->Finish();
  }
  wire::ControlPanel::Stub& stub() { return *stub_; }

 private:
  template <typename Method, typename Request>
  wire::RunStatus good(Method method, Request request) {
    request.set_protocol(kProtocolVersion);
    wire::RunStatus status;
    const grpc::Status how = call(method, request, status);
    EXPECT_TRUE(how.ok()) << how.error_message();
    return status;
  }

  std::unique_ptr<wire::ControlPanel::Stub> stub_;
};

}  // namespace robosim
