#include "recording/unpacked_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include <zlib.h>

#include "base/error_list.h"
#include "base/input_file.h"
#include "mcap/reader.h"
#include "recording/mcap_recording.h"

namespace robosim {
namespace {

constexpr std::size_t kWindowBytes = 32768;  // deflate's window
constexpr std::size_t kInputBytes = 128 * 1024, kOutputBytes = 256 * 1024;
constexpr std::uint64_t kBytesPerCheckpoint = 4 << 20;
/// For inflateInit2(): with a gzip header and trailer, or with neither.
constexpr int kGzip = 15 + 16, kRaw = -15;
constexpr const char* kCutOff = "it is cut off";

/// State from which decompression can continue.
struct Checkpoint {
  std::uint64_t unpacked = 0;         ///< position in the decompressed data
  std::uint64_t packed = 0;           ///< position in the file, of the first byte all of whose bits are needed
  int bits = 0;                       ///< number of bits needed of the byte before it
  bool is_beginning = false;          ///< at the beginning of a gzip member
  mcap::Reader::Place place{};        ///< of an MCAP file, instead of the position
  std::vector<unsigned char> window;  ///< the preceding decompressed data
};

/// The first checkpoint after a position in the decompressed data.
std::vector<Checkpoint>::const_iterator firstAfter(const std::vector<Checkpoint>& checkpoints, std::uint64_t position) {
  return std::upper_bound(checkpoints.begin(), checkpoints.end(), position,
                          [](std::uint64_t p, const Checkpoint& checkpoint) { return p < checkpoint.unpacked; });
}

}  // namespace

/// The rawlog in an MCAP file (kRawlogTopic).
class RawlogMessages {
 public:
  explicit RawlogMessages(const std::filesystem::path& path) : reader_(path) {}

  /// Appends the bytes of the next message of the topic; none at the end.
  std::span<const std::uint8_t> next() {
    while (const auto message = reader_.next()) {
      if (reader_.channels().at(message->channel).topic != kRawlogTopic) continue;
      if (message->data.size() >= kRawlogDataOffset) return message->data.subspan(kRawlogDataOffset);
    }
    return {};
  }
  mcap::Reader& reader() { return reader_; }

 private:
  mcap::Reader reader_;
};

struct UnpackedFile::Impl {
  explicit Impl(const std::filesystem::path& path) : name(path), file(path) {}

  std::filesystem::path name;
  InputFile file;
  std::optional<RawlogMessages> messages;  ///< of an MCAP file
  Access access = Access::sequential;
  bool is_packed = false, has_stream = false;
  z_stream stream{};
  bool is_raw = false;              ///< the stream has no header and trailer
  bool is_between_members = false;  ///< of a file with several gzip members
  bool is_over = false;
  std::string fault;
  std::array<unsigned char, kInputBytes> input;
  std::uint64_t input_end = 0;  ///< position in the file of the end of `input`
  std::vector<unsigned char> output = std::vector<unsigned char>(kOutputBytes);
  std::size_t begin = 0, end = 0;  ///< unread range of `output`
  std::uint64_t unpacked = 0;      ///< position of `end` in the decompressed data
  std::vector<Checkpoint> checkpoints;
  std::vector<Checkpoint> noted;  ///< beginnings of members that have not been read; none after one that was wrong
  std::uint64_t member_packed = 0, member_unpacked = 0;  ///< beginning of the present member

  ~Impl() {
    if (has_stream) inflateEnd(&stream);
  }

  void open();
  bool fillInput();
  void fill(std::size_t at_least);
  void openMcap();
  void takeMessage();
  void copyMore();
  void unpackMore();
  void endMember();
  void checkNoted();
  void beginMember();
  void addCheckpoint(int bits, bool is_beginning);
  void restore(const Checkpoint& checkpoint);
  std::uint64_t packedPosition() const { return input_end - stream.avail_in; }
  void stop(std::string why) {
    is_over = true;
    fault = std::move(why);
  }
};

void UnpackedFile::Impl::open() {
  stream.next_in = input.data();
  while (stream.avail_in < mcap::kMagic.size() && fillInput()) {
  }
  if (std::string_view(reinterpret_cast<const char*>(input.data()), stream.avail_in).starts_with(mcap::kMagic)) {
    return openMcap();
  }
  is_packed = stream.avail_in >= 2 && input[0] == 0x1f && input[1] == 0x8b;
  if (!is_packed) return;
  has_stream = inflateInit2(&stream, kGzip) == Z_OK;
  if (!has_stream) throw std::bad_alloc();
  addCheckpoint(0, true);
}

void UnpackedFile::Impl::openMcap() {
  if (!file.size()) {
    throw ConfigError(name.string() +
                      ": is a pipe with an MCAP file, which is read by its index; give the file itself");
  }
  messages.emplace(name);
  takeMessage();
  if (end > 0 || !fault.empty()) return;
  throw ConfigError(name.string() + ": is an MCAP file without messages on the topic " + kRawlogTopic +
                    ", so that it has no rawlog");
}

/// Appends the next message to the output.
void UnpackedFile::Impl::takeMessage() {
  const auto bytes = messages->next();
  if (bytes.empty()) {
    const auto& reader = messages->reader();
    return stop(reader.isCutOff() ? kCutOff : reader.fault());
  }
  const mcap::Reader::Place place = messages->reader().place();
  if (access == Access::random && (checkpoints.empty() || (checkpoints.back().unpacked < unpacked &&
                                                           checkpoints.back().place.record != place.record))) {
    Checkpoint checkpoint;
    checkpoint.unpacked = unpacked;
    checkpoint.place = place;
    checkpoints.push_back(std::move(checkpoint));
  }
  if (output.size() < end + bytes.size()) output.resize(end + bytes.size());
  std::copy(bytes.begin(), bytes.end(), output.begin() + static_cast<std::ptrdiff_t>(end));
  end += bytes.size();
  unpacked += bytes.size();
}

/// Appends more of the file to the remaining input. @returns whether there was more
bool UnpackedFile::Impl::fillInput() {
  std::memmove(input.data(), stream.next_in, stream.avail_in);
  stream.next_in = input.data();
  std::size_t got = 0;
  try {
    got = file.read(input.data() + stream.avail_in, input.size() - stream.avail_in);
  } catch (const std::system_error& error) {
    stop(error.code().message());
  }
  stream.avail_in += static_cast<unsigned>(got);
  input_end += got;
  return got > 0;
}

void UnpackedFile::Impl::fill(std::size_t at_least) {
  if (begin == end) begin = end = 0;
  if (begin + at_least > output.size()) {
    std::copy(output.begin() + static_cast<std::ptrdiff_t>(begin), output.begin() + static_cast<std::ptrdiff_t>(end),
              output.begin());
    end -= begin;
    begin = 0;
  }
  while (end - begin < at_least && !is_over) {
    messages ? takeMessage() : is_packed ? unpackMore() : copyMore();
  }
}

void UnpackedFile::Impl::copyMore() {
  if (stream.avail_in == 0 && !fillInput()) {
    is_over = true;
    return;
  }
  const std::size_t size = std::min<std::size_t>(stream.avail_in, output.size() - end);
  std::memcpy(&output[end], stream.next_in, size);
  stream.next_in += size;
  stream.avail_in -= static_cast<unsigned>(size);
  end += size;
  unpacked += size;
}

void UnpackedFile::Impl::unpackMore() {
  if (is_between_members) return beginMember();
  if (stream.avail_in == 0 && !fillInput()) {
    if (fault.empty()) stop(kCutOff);
    return;
  }
  stream.next_out = &output[end];
  stream.avail_out = static_cast<unsigned>(output.size() - end);
  const unsigned room = stream.avail_out;
  // Z_BLOCK stops at the end of a block, where a checkpoint is possible.
  const int result = inflate(&stream, access == Access::random ? Z_BLOCK : Z_NO_FLUSH);
  const std::size_t size = room - stream.avail_out;
  end += size;
  unpacked += size;
  if (result == Z_STREAM_END) return endMember();
  // Z_BUF_ERROR: more input or output space is needed.
  if (result != Z_OK && result != Z_BUF_ERROR) return stop(stream.msg ? stream.msg : "it cannot be unpacked");
  const bool at_block = (stream.data_type & 128) != 0 && (stream.data_type & 64) == 0;
  if (at_block && access == Access::random && noted.empty() &&
      unpacked >= checkpoints.back().unpacked + kBytesPerCheckpoint) {
    addCheckpoint(stream.data_type & 7, false);
  }
}

/// A raw stream does not consume the trailer of 8 bytes.
void UnpackedFile::Impl::endMember() {
  for (std::size_t left = is_raw ? 8 : 0; left > 0;) {
    if (stream.avail_in == 0 && !fillInput()) return stop(kCutOff);
    const auto taken = std::min<std::size_t>(left, stream.avail_in);
    stream.next_in += taken;
    stream.avail_in -= static_cast<unsigned>(taken);
    left -= taken;
  }
  is_between_members = true;
  checkNoted();
}

/// Forgets the noted members if the one that has ended is another one than noted. One without content is never noted.
void UnpackedFile::Impl::checkNoted() {
  if (noted.empty() || unpacked == member_unpacked) return;
  const auto after = firstAfter(noted, member_unpacked);
  const bool is_noted =
      after != noted.begin() && (after - 1)->unpacked == member_unpacked && (after - 1)->packed == member_packed;
  if (!is_noted || (after != noted.end() && after->unpacked < unpacked)) noted.clear();
}

/// A gzip member is followed by another one; other data is ignored.
void UnpackedFile::Impl::beginMember() {
  while (stream.avail_in < 2 && fillInput()) {
  }
  is_between_members = false;
  if (stream.avail_in < 2 || stream.next_in[0] != 0x1f || stream.next_in[1] != 0x8b) {
    is_over = true;
    return;
  }
  inflateReset2(&stream, kGzip);
  is_raw = false;
  member_packed = packedPosition();
  member_unpacked = unpacked;
  if (access == Access::random && noted.empty() && unpacked >= checkpoints.back().unpacked + kBytesPerCheckpoint)
    addCheckpoint(0, true);
}

void UnpackedFile::Impl::addCheckpoint(int bits, bool is_beginning) {
  if (!checkpoints.empty() && unpacked <= checkpoints.back().unpacked) return;  // already stored
  Checkpoint checkpoint{unpacked, packedPosition(), bits, is_beginning, {}, {}};
  if (!is_beginning) {
    checkpoint.window.resize(kWindowBytes);
    unsigned size = 0;
    inflateGetDictionary(&stream, checkpoint.window.data(), &size);
    checkpoint.window.resize(size);
    checkpoint.window.shrink_to_fit();
  }
  checkpoints.push_back(std::move(checkpoint));
}

void UnpackedFile::Impl::restore(const Checkpoint& checkpoint) {
  const std::uint64_t from = checkpoint.packed - (checkpoint.bits > 0 ? 1 : 0);
  is_over = is_between_members = false;
  fault.clear();
  begin = end = 0;
  unpacked = checkpoint.unpacked;
  if (messages) return messages->reader().seek(checkpoint.place);
  stream.avail_in = 0;
  stream.next_in = input.data();
  input_end = from;
  try {
    file.seek(from);
  } catch (const std::system_error& error) {
    return stop(error.code().message());
  }
  if (!is_packed) return;
  is_raw = !checkpoint.is_beginning;
  member_packed = checkpoint.packed;
  member_unpacked = checkpoint.unpacked;
  inflateReset2(&stream, is_raw ? kRaw : kGzip);
  if (checkpoint.bits > 0) {
    if (!fillInput()) return stop(kCutOff);
    const int byte = *stream.next_in++;
    --stream.avail_in;
    inflatePrime(&stream, checkpoint.bits, byte >> (8 - checkpoint.bits));
  }
  if (!checkpoint.window.empty()) {
    inflateSetDictionary(&stream, checkpoint.window.data(), static_cast<unsigned>(checkpoint.window.size()));
  }
}

UnpackedFile::UnpackedFile(const std::filesystem::path& file, Access access) : impl_(std::make_unique<Impl>(file)) {
  impl_->access = access;
  impl_->open();
}

UnpackedFile::~UnpackedFile() = default;

std::size_t UnpackedFile::read(void* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    if (impl_->begin == impl_->end) impl_->fill(1);
    const std::size_t got = std::min(size - done, impl_->end - impl_->begin);
    if (got == 0) break;
    std::memcpy(static_cast<char*>(to) + done, &impl_->output[impl_->begin], got);
    impl_->begin += got;
    done += got;
  }
  return done;
}

std::size_t UnpackedFile::peek(void* to, std::size_t size) {
  assert(size <= 1024);
  if (impl_->end - impl_->begin < size) impl_->fill(size);
  size = std::min(size, impl_->end - impl_->begin);
  std::memcpy(to, impl_->output.data() + impl_->begin, size);
  return size;
}

std::uint64_t UnpackedFile::position() const { return impl_->unpacked - (impl_->end - impl_->begin); }

void UnpackedFile::seek(std::uint64_t position) {
  assert(impl_->access == Access::random);
  const std::uint64_t here = this->position();
  if (!impl_->is_packed && !impl_->messages) {
    Checkpoint checkpoint;
    checkpoint.unpacked = checkpoint.packed = position;
    if (position < here || position > impl_->unpacked) return impl_->restore(checkpoint);
  } else {
    const auto after = firstAfter(impl_->checkpoints, position), after_noted = firstAfter(impl_->noted, position);
    const bool is_noted = after_noted != impl_->noted.begin() && (after_noted - 1)->unpacked > (after - 1)->unpacked;
    const Checkpoint& checkpoint = is_noted ? *(after_noted - 1) : *(after - 1);
    if (position < here || checkpoint.unpacked > impl_->unpacked) impl_->restore(checkpoint);
  }
  while (this->position() < position) {
    if (impl_->begin == impl_->end) impl_->fill(1);
    if (impl_->begin == impl_->end) return;
    impl_->begin += std::min<std::uint64_t>(position - this->position(), impl_->end - impl_->begin);
  }
}

std::optional<std::uint64_t> UnpackedFile::endOfMember() {
  Impl& impl = *impl_;
  if (!impl.is_packed || impl.begin != impl.end) return std::nullopt;
  impl.begin = impl.end = 0;
  // The end of a member may follow the last byte of its content.
  while (impl.end == 0 && !impl.is_between_members && !impl.is_over) impl.unpackMore();
  return impl.end == 0 && impl.is_between_members ? std::optional(impl.packedPosition()) : std::nullopt;
}

void UnpackedFile::seekMember(std::uint64_t packed, std::uint64_t unpacked) {
  assert(impl_->is_packed);
  Checkpoint beginning;
  beginning.unpacked = unpacked;
  beginning.packed = packed;
  beginning.is_beginning = true;
  impl_->restore(beginning);
  impl_->is_between_members = !impl_->is_over;  // data that is no member is ignored
}

void UnpackedFile::noteMember(std::uint64_t packed, std::uint64_t unpacked) {
  assert(impl_->access == Access::random && impl_->is_packed);
  assert(impl_->noted.empty() || impl_->noted.back().unpacked < unpacked);
  Checkpoint beginning;
  beginning.unpacked = unpacked;
  beginning.packed = packed;
  beginning.is_beginning = true;
  impl_->noted.push_back(std::move(beginning));
}

bool UnpackedFile::atEnd() {
  if (impl_->begin == impl_->end) impl_->fill(1);
  return impl_->begin == impl_->end && impl_->fault.empty();
}

const std::string& UnpackedFile::fault() const { return impl_->fault; }

bool UnpackedFile::isCutOff() const { return impl_->fault == kCutOff; }

}  // namespace robosim
