#include "server/viewer.h"

#include <cmath>

#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

RobotLook decode(const wire::RobotView& in) {
  if (!std::isfinite(in.x_m()) || !std::isfinite(in.y_m()) || !std::isfinite(in.phi_rad()) ||
      !std::isfinite(in.laser_pan_rad())) {
    throw WireError("a frame in which a robot is nowhere: its pose is not finite");
  }
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("a frame with the unknown activity " + std::to_string(in.activity()));
  }
  return {{in.x_m(), in.y_m(), in.phi_rad()}, in.laser_pan_rad(), in.stalled(), static_cast<Activity>(in.activity())};
}

}  // namespace

void encode(const RobotLook& look, std::size_t robot, wire::RobotView& out) {
  out.set_robot(static_cast<std::uint32_t>(robot));
  out.set_x_m(look.world_from_robot.x);
  out.set_y_m(look.world_from_robot.y);
  out.set_phi_rad(look.world_from_robot.phi);
  out.set_laser_pan_rad(look.laser_pan_rad);
  out.set_stalled(look.stalled);
  out.set_activity(static_cast<wire::Activity>(look.activity));
}

bool update(Sight& sight, const wire::Frame& frame) {
  if (frame.has_world()) {
    sight.world = loadWorld(decode(frame.world()), {});
    sight.world_version = frame.world_version();
    sight.robots.assign(sight.world.fleet.robots.size(), {});
    if (static_cast<std::size_t>(frame.robots_size()) != sight.robots.size()) {
      throw WireError("a first frame that does not show every robot");
    }
  }
  for (const auto& robot : frame.robots()) {
    if (robot.robot() >= sight.robots.size()) throw WireError("a frame with a robot that the world does not have");
    sight.robots[robot.robot()] = decode(robot);
  }
  sight.step = frame.step();
  sight.time_s = frame.time_s();
  sight.winner = frame.winner();
  return frame.has_world();
}

struct Viewer::Impl {
  DialOptions dialled;
  std::unique_ptr<wire::Viewing::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream;
  wire::FrameRequest request;
  wire::Frame frame;
  Sight sight;
  bool is_other_world = false;

  explicit Impl(const DialOptions& options) : dialled(options), stub(wire::Viewing::NewStub(dial(options))) {
    showToken(context, options);
    stream = stub->Watch(&context);
    request.set_protocol(kProtocolVersion);
    if (!look()) throw ConnectionError({grpc::StatusCode::UNAVAILABLE, "the run is over"}, dialled);
    if (!is_other_world) throw WireError("the environment's first frame has no world");
  }

  ~Impl() {
    if (!stream) return;
    context.TryCancel();
    stream->Finish();
  }

  bool look() {
    if (!stream) return false;
    stream->Write(request);  // a stream that has broken says why when it is read
    if (stream->Read(&frame)) {
      is_other_world = update(sight, frame);
      return true;
    }
    const grpc::Status status = stream->Finish();
    stream.reset();
    if (!status.ok()) throw ConnectionError(status, dialled);
    return false;
  }
};

Viewer::Viewer(const DialOptions& dial_options) : impl_(std::make_unique<Impl>(dial_options)) {}
Viewer::~Viewer() = default;
const Sight& Viewer::sight() const { return impl_->sight; }
bool Viewer::look() { return impl_->look(); }
bool Viewer::isOtherWorld() const { return impl_->is_other_world; }

}  // namespace robosim
