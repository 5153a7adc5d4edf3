#include "client/viewer.h"

#include <mutex>

#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"

namespace robosim {

struct Viewer::Impl {
  ConnectOptions connect_options;
  std::unique_ptr<wire::Viewing::Stub> stub;
  grpc::ClientContext context;
  wire::Frame frame;
  ViewedRun run;
  bool is_new_world = false;

  std::mutex mutex;  ///< guards the members below, and all operations on the stream except reads
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream;  ///< null when it has ended
  wire::FrameRequest request;
  bool has_left = false;

  Impl(const ConnectOptions& options, const ReadingsSelection& selection)
      : connect_options(options), stub(wire::Viewing::NewStub(connect(options))) {
    attachToken(context, options);
    stream = stub->Watch(&context);
    request.set_protocol(kProtocolVersion);
    encode(selection, request);
    if (!waitForFrame()) throw ConnectionError({grpc::StatusCode::UNAVAILABLE, "the run is over"}, connect_options);
    if (!is_new_world) throw WireError("the environment's first frame has no world");
  }

  ~Impl() {
    if (!stream) return;
    context.TryCancel();
    stream->Finish();
  }

  bool waitForFrame() {
    if (!stream) return false;
    ask();
    if (stream->Read(&frame)) {
      is_new_world = update(run, frame);
      return true;
    }
    const std::lock_guard lock(mutex);
    const grpc::Status status = stream->Finish();
    stream.reset();
    if (!status.ok() && !has_left) throw ConnectionError(status, connect_options);
    return false;
  }

  void ask() {
    const std::lock_guard lock(mutex);
    request.set_amends(false);
    stream->Write(request);  // for a broken stream, Finish() returns the reason
  }

  void select(const ReadingsSelection& selection) {
    const std::lock_guard lock(mutex);
    encode(selection, request);
    request.set_amends(true);
    if (stream) stream->Write(request);
  }

  void leave() {
    const std::lock_guard lock(mutex);
    has_left = true;
    context.TryCancel();
  }
};

Viewer::Viewer(const ConnectOptions& connect_options, const ReadingsSelection& selection)
    : impl_(std::make_unique<Impl>(connect_options, selection)) {}
Viewer::~Viewer() = default;
const ViewedRun& Viewer::run() const { return impl_->run; }
bool Viewer::waitForFrame() { return impl_->waitForFrame(); }
bool Viewer::isNewWorld() const { return impl_->is_new_world; }
void Viewer::select(const ReadingsSelection& selection) { impl_->select(selection); }
void Viewer::leave() { impl_->leave(); }

}  // namespace robosim
