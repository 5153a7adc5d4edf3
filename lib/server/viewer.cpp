#include "server/viewer.h"

#include <mutex>

#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"

namespace robosim {

struct Viewer::Impl {
  DialOptions dialled;
  std::unique_ptr<wire::Viewing::Stub> stub;
  grpc::ClientContext context;
  wire::Frame frame;
  Sight sight;
  bool is_other_world = false;

  std::mutex mutex;  ///< for what is below, and for all that is done to the stream but reading
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream;  ///< null when it has ended
  wire::FrameRequest request;
  bool has_left = false;

  Impl(const DialOptions& options, const ReadingsWish& wish)
      : dialled(options), stub(wire::Viewing::NewStub(dial(options))) {
    showToken(context, options);
    stream = stub->Watch(&context);
    request.set_protocol(kProtocolVersion);
    encode(wish, request);
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
    ask();
    if (stream->Read(&frame)) {
      is_other_world = update(sight, frame);
      return true;
    }
    const std::lock_guard lock(mutex);
    const grpc::Status status = stream->Finish();
    stream.reset();
    if (!status.ok() && !has_left) throw ConnectionError(status, dialled);
    return false;
  }

  void ask() {
    const std::lock_guard lock(mutex);
    request.set_amends(false);
    stream->Write(request);  // a stream that has broken says why when it is read
  }

  void want(const ReadingsWish& wish) {
    const std::lock_guard lock(mutex);
    encode(wish, request);
    request.set_amends(true);
    if (stream) stream->Write(request);
  }

  void leave() {
    const std::lock_guard lock(mutex);
    has_left = true;
    context.TryCancel();
  }
};

Viewer::Viewer(const DialOptions& dial_options, const ReadingsWish& wish)
    : impl_(std::make_unique<Impl>(dial_options, wish)) {}
Viewer::~Viewer() = default;
const Sight& Viewer::sight() const { return impl_->sight; }
bool Viewer::look() { return impl_->look(); }
bool Viewer::isOtherWorld() const { return impl_->is_other_world; }
void Viewer::want(const ReadingsWish& wish) { impl_->want(wish); }
void Viewer::leave() { impl_->leave(); }

}  // namespace robosim
