#pragma once
#include <string>

#include "client/control_panel.h"
#include "net/connect.h"
#include "net/wire_error.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "tests/scenarios/served_world.h"

namespace robosim {

/// A control panel connected to the world that the test serves.
class Panel : public ControlPanel {
 public:
  explicit Panel(const ServedWorld& world) : ControlPanel(world.connectOptions()) {}

  using ControlPanel::load;
  /// @param file relative to the project's folder
  v1::RunStatus load(const std::string& file) { return load(readWorldSource(ROBOSIM_SOURCE_DIR "/" + file)); }
};

/// Status of a load of these bytes, sent in pieces.
inline grpc::Status howLoadEnds(const ConnectOptions& connect_options, const std::string& bytes,
                                std::size_t piece_bytes) {
  grpc::ClientContext context;
  v1::RunStatus status;
  const auto stub = v1::ControlPanel::NewStub(connect(connect_options));
  const auto stream = stub->Load(&context, &status);
  for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
    v1::LoadRequest piece;
    piece.set_protocol(kProtocolVersion);
    piece.set_piece(bytes.substr(at, piece_bytes));
    if (!stream->Write(piece)) break;
  }
  stream->WritesDone();
  return stream->Finish();
}

}  // namespace robosim
