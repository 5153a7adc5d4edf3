#include "recording/gzip_file.h"

#include <cassert>
#include <utility>

#include <isa-l/igzip_lib.h>

#include "base/vector_registers.h"

namespace robosim {

struct GzipFile::Compressor {
  Compressor() {
    isal_deflate_init(&stream);
    stream.level = 0;  // 20 % larger output than level 1, in half the time
    stream.gzip_flag = IGZIP_GZIP;
    stream.flush = NO_FLUSH;
  }

  isal_zstream stream;
  std::uint8_t out[64 * 1024];
};

GzipFile::GzipFile(const std::filesystem::path& file) : file_(file), compressor_(std::make_unique<Compressor>()) {}

GzipFile::~GzipFile() = default;

void GzipFile::write(std::span<const std::uint8_t> bytes) {
  file_.checkOpen();
  assert(!is_finished_);
  static_assert(kMaxPiece <= UINT32_MAX, "ISA-L counts bytes in 32 bits");
  for (; bytes.size() > kMaxPiece; bytes = bytes.subspan(kMaxPiece)) compress(bytes.first(kMaxPiece), false);
  compress(bytes, false);
}

void GzipFile::finish() {
  file_.checkOpen();
  if (!std::exchange(is_finished_, true)) compress({}, true);
  file_.finish();
}

void GzipFile::commit() {
  finish();
  file_.commit();
}

void GzipFile::compress(std::span<const std::uint8_t> bytes, bool last) {
  auto& stream = compressor_->stream;
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());  // only read; ISA-L's declaration lacks const
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  stream.end_of_stream = last;
  do {
    stream.next_out = compressor_->out;
    stream.avail_out = sizeof compressor_->out;
    [[maybe_unused]] const int status = isal_deflate(&stream);
    assert(status == COMP_OK);
    clearVectorRegisters();
    file_.write({compressor_->out, static_cast<std::size_t>(stream.next_out - compressor_->out)});
  } while (stream.avail_out == 0);
}

}  // namespace robosim
