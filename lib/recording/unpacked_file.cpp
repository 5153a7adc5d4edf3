#include "recording/unpacked_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

#include <zlib.h>

namespace robosim {
namespace {

constexpr std::size_t kWindowBytes = 32768;  // as far as deflate looks back
constexpr std::size_t kInputBytes = 128 * 1024, kOutputBytes = 256 * 1024;
constexpr std::uint64_t kBytesPerPlace = 4 << 20;
/// For inflateInit2(): with a gzip header and trailer, or with neither.
constexpr int kGzip = 15 + 16, kRaw = -15;

/// Where unpacking can begin anew.
struct Place {
  std::uint64_t unpacked = 0;         ///< the first byte that comes from there
  std::uint64_t packed = 0;           ///< the first byte of the file of which all bits are needed
  int bits = 0;                       ///< that are needed of the byte before it
  bool is_beginning = false;          ///< of a gzip file in the file
  std::vector<unsigned char> window;  ///< what was unpacked before
};

}  // namespace

struct UnpackedFile::Impl {
  std::FILE* file = nullptr;
  Places places_kept = Places::forget;
  bool is_packed = false, has_stream = false;
  z_stream stream{};
  bool is_raw = false;              ///< the stream knows nothing of header and trailer
  bool is_between_members = false;  ///< of several gzip files in one
  bool is_over = false;
  std::string fault;
  std::array<unsigned char, kInputBytes> input;
  std::uint64_t input_end = 0;  ///< of `input`, in the file
  std::vector<unsigned char> output = std::vector<unsigned char>(kOutputBytes);
  std::size_t begin = 0, end = 0;  ///< in `output`: not yet read
  std::uint64_t unpacked = 0;      ///< of `end`
  std::vector<Place> places;

  ~Impl() {
    if (has_stream) inflateEnd(&stream);
    if (file) std::fclose(file);
  }

  void open(const std::filesystem::path& path);
  bool fillInput();
  void fill(std::size_t at_least);
  void copyOn();
  void unpackOn();
  void endMember();
  void beginMember();
  void keepPlace(int bits, bool is_beginning);
  void goTo(const Place& place);
  std::uint64_t packedPosition() const { return input_end - stream.avail_in; }
  void stop(std::string why) {
    is_over = true;
    fault = std::move(why);
  }
};

void UnpackedFile::Impl::open(const std::filesystem::path& path) {
  file = std::fopen(path.c_str(), "rbe");
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
  std::setvbuf(file, nullptr, _IONBF, 0);
  stream.next_in = input.data();
  fillInput();
  is_packed = stream.avail_in >= 2 && input[0] == 0x1f && input[1] == 0x8b;
  if (!is_packed) return;
  has_stream = inflateInit2(&stream, kGzip) == Z_OK;
  if (!has_stream) throw std::bad_alloc();
  keepPlace(0, true);
}

/// More of the file, behind what is left of it. @returns whether there was more
bool UnpackedFile::Impl::fillInput() {
  std::memmove(input.data(), stream.next_in, stream.avail_in);
  stream.next_in = input.data();
  const std::size_t got = std::fread(input.data() + stream.avail_in, 1, input.size() - stream.avail_in, file);
  if (got == 0 && std::ferror(file)) stop(std::strerror(errno));
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
  while (end - begin < at_least && !is_over) is_packed ? unpackOn() : copyOn();
}

void UnpackedFile::Impl::copyOn() {
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

void UnpackedFile::Impl::unpackOn() {
  if (is_between_members) return beginMember();
  if (stream.avail_in == 0 && !fillInput()) {
    if (fault.empty()) stop("it is cut off");
    return;
  }
  stream.next_out = &output[end];
  stream.avail_out = static_cast<unsigned>(output.size() - end);
  const unsigned room = stream.avail_out;
  // It stops where a block ends, which is where one can begin.
  const int result = inflate(&stream, places_kept == Places::keep ? Z_BLOCK : Z_NO_FLUSH);
  const std::size_t size = room - stream.avail_out;
  end += size;
  unpacked += size;
  if (result == Z_STREAM_END) return endMember();
  // Z_BUF_ERROR: it wants more input, or room, than there is now.
  if (result != Z_OK && result != Z_BUF_ERROR) return stop(stream.msg ? stream.msg : "it cannot be unpacked");
  const bool at_block = (stream.data_type & 128) != 0 && (stream.data_type & 64) == 0;
  if (at_block && places_kept == Places::keep && unpacked >= places.back().unpacked + kBytesPerPlace) {
    keepPlace(stream.data_type & 7, false);
  }
}

/// A raw stream leaves the trailer, 8 bytes, to us.
void UnpackedFile::Impl::endMember() {
  for (std::size_t left = is_raw ? 8 : 0; left > 0;) {
    if (stream.avail_in == 0 && !fillInput()) return stop("it is cut off");
    const auto taken = std::min<std::size_t>(left, stream.avail_in);
    stream.next_in += taken;
    stream.avail_in -= static_cast<unsigned>(taken);
    left -= taken;
  }
  is_between_members = true;
}

/// What follows a gzip file is another one, or is nothing to us.
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
  if (places_kept == Places::keep && unpacked >= places.back().unpacked + kBytesPerPlace) keepPlace(0, true);
}

void UnpackedFile::Impl::keepPlace(int bits, bool is_beginning) {
  if (!places.empty() && unpacked <= places.back().unpacked) return;  // passed before
  Place place{unpacked, packedPosition(), bits, is_beginning, {}};
  if (!is_beginning) {
    place.window.resize(kWindowBytes);
    unsigned size = 0;
    inflateGetDictionary(&stream, place.window.data(), &size);
    place.window.resize(size);
    place.window.shrink_to_fit();
  }
  places.push_back(std::move(place));
}

void UnpackedFile::Impl::goTo(const Place& place) {
  const std::uint64_t from = place.packed - (place.bits > 0 ? 1 : 0);
  is_over = is_between_members = false;
  fault.clear();
  begin = end = 0;
  unpacked = place.unpacked;
  stream.avail_in = 0;
  stream.next_in = input.data();
  input_end = from;
  std::clearerr(file);
  if (fseeko(file, static_cast<off_t>(from), SEEK_SET) != 0) return stop(std::strerror(errno));
  if (!is_packed) return;
  is_raw = !place.is_beginning;
  inflateReset2(&stream, is_raw ? kRaw : kGzip);
  if (place.bits > 0) {
    if (!fillInput()) return stop("it is cut off");
    const int byte = *stream.next_in++;
    --stream.avail_in;
    inflatePrime(&stream, place.bits, byte >> (8 - place.bits));
  }
  if (!place.window.empty()) {
    inflateSetDictionary(&stream, place.window.data(), static_cast<unsigned>(place.window.size()));
  }
}

UnpackedFile::UnpackedFile(const std::filesystem::path& file, Places places) : impl_(std::make_unique<Impl>()) {
  impl_->places_kept = places;
  impl_->open(file);
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
  assert(impl_->places_kept == Places::keep);
  const std::uint64_t here = this->position();
  if (!impl_->is_packed) {
    Place place;
    place.unpacked = place.packed = position;
    if (position < here || position > impl_->unpacked) return impl_->goTo(place);
  } else {
    const auto after = std::upper_bound(impl_->places.begin(), impl_->places.end(), position,
                                        [](std::uint64_t p, const Place& place) { return p < place.unpacked; });
    const Place& place = *(after - 1);
    if (position < here || place.unpacked > impl_->unpacked) impl_->goTo(place);
  }
  while (this->position() < position) {
    if (impl_->begin == impl_->end) impl_->fill(1);
    if (impl_->begin == impl_->end) return;
    impl_->begin += std::min<std::uint64_t>(position - this->position(), impl_->end - impl_->begin);
  }
}

bool UnpackedFile::atEnd() {
  if (impl_->begin == impl_->end) impl_->fill(1);
  return impl_->begin == impl_->end && impl_->fault.empty();
}

const std::string& UnpackedFile::fault() const { return impl_->fault; }

}  // namespace robosim
