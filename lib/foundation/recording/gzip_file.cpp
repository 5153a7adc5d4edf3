#include "recording/gzip_file.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <isa-l/igzip_lib.h>

#include "base/vector_registers.h"
#include "recording/gzip_members.h"

namespace robosim {

/// A member, which is kept in memory until its size is known, with which its header begins.
struct GzipFile::Member {
  Member() {
    isal_deflate_init(&stream);
    begin();
  }

  void begin() {
    isal_deflate_reset(&stream);
    stream.level = 0;                      // 20 % larger output than level 1, in half the time
    stream.gzip_flag = IGZIP_GZIP_NO_HDR;  // the trailer only
    stream.flush = NO_FLUSH;
    packed.resize(MemberHeader::kBytes);
  }

  void compress(std::span<const std::uint8_t> bytes, bool is_last) {
    constexpr std::size_t kRoom = 8 * 1024;  // cleared before it is written, so not much more than is needed
    stream.next_in = const_cast<std::uint8_t*>(bytes.data());  // only read; ISA-L's declaration lacks const
    stream.avail_in = static_cast<std::uint32_t>(bytes.size());
    stream.end_of_stream = is_last;
    do {
      const std::size_t before = packed.size();
      packed.resize(before + kRoom);
      stream.next_out = packed.data() + before;
      stream.avail_out = kRoom;
      [[maybe_unused]] const int status = isal_deflate(&stream);
      assert(status == COMP_OK);
      clearVectorRegisters();
      packed.resize(before + kRoom - stream.avail_out);
    } while (stream.avail_out == 0);
  }

  isal_zstream stream;
  std::vector<std::uint8_t> packed;  ///< room for the header, and what has been compressed
};

GzipFile::GzipFile(const std::filesystem::path& file)
    : file_(file), member_(std::make_unique<Member>()), last_page_(IndexPage::kNone) {}

GzipFile::~GzipFile() = default;

void GzipFile::write(std::span<const std::uint8_t> bytes) {
  file_.checkOpen();
  assert(!is_finished_);
  static_assert(kMaxPiece <= UINT32_MAX, "ISA-L counts bytes in 32 bits");
  for (; bytes.size() > kMaxPiece; bytes = bytes.subspan(kMaxPiece)) append(bytes.first(kMaxPiece));
  append(bytes);
}

void GzipFile::append(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 31;  // the header counts in 32 bits
  if (member_bytes_ + bytes.size() > kMostBytes) endMember();
  member_->compress(bytes, false);
  member_bytes_ += bytes.size();
}

void GzipFile::endMember(MemberNote note) {
  if (member_bytes_ == 0) return;
  member_->compress({}, true);
  auto& packed = member_->packed;
  const MemberHeader header{static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(member_bytes_)};
  const auto header_bytes = header.bytes();
  std::copy(header_bytes.begin(), header_bytes.end(), packed.begin());
  file_.write(packed);
  note.packed = packed_;
  note.unpacked = unpacked_;
  appendTo(index_, note);
  packed_ += packed.size();
  unpacked_ += std::exchange(member_bytes_, 0);
  member_->begin();
  writePages(IndexPage::kMaxContentBytes);
}

/// Writes pages of the index as long as it has so many bytes.
void GzipFile::writePages(std::size_t from_bytes) {
  while (!index_.empty() && index_.size() >= from_bytes) {
    const std::size_t size = std::min(index_.size(), IndexPage::kMaxContentBytes);
    const auto page = IndexPage{packed_, last_page_, std::span<const std::uint8_t>(index_).first(size)}.bytes();
    file_.write(page);
    last_page_ = packed_;
    packed_ += page.size();
    index_.erase(index_.begin(), index_.begin() + static_cast<std::ptrdiff_t>(size));
  }
}

void GzipFile::finish(MemberNote last, IndexSummary summary) {
  file_.checkOpen();
  if (!std::exchange(is_finished_, true)) {
    endMember(std::move(last));
    summary.unpacked = unpacked_;
    appendTo(index_, summary);
    writePages(0);
  }
  file_.finish();
}

void GzipFile::commit() {
  if (!is_finished_) finish();
  file_.commit();
}

}  // namespace robosim
