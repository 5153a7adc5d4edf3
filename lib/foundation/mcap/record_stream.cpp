#include "mcap/record_stream.h"

#include <algorithm>
#include <cstring>
#include <system_error>

#include "base/error_list.h"

namespace robosim::mcap {
namespace {

constexpr std::size_t kBufferBytes = 256 * 1024;
/// Larger records are damage: a chunk of kMaxChunkBytes is not larger when it is packed.
constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{1} << 30;

}  // namespace

RecordStream::RecordStream(const std::filesystem::path& file) : file_(file) {
  const std::size_t got = fill(kMagic.size());
  const std::string_view beginning(reinterpret_cast<const char*>(buffer_.data()), std::min(got, kMagic.size()));
  if (beginning == kMagic) {
    seek(kMagic.size());
    return;
  }
  constexpr std::size_t kVersion = 5;  // position of the digit
  if (beginning.size() == kMagic.size() && beginning.starts_with(kMagic.substr(0, kVersion))) {
    throw ConfigError(file.string() + ": is an MCAP file of version \"" + beginning[kVersion] +
                      "\"; version 0 can be read");
  }
  throw ConfigError(file.string() + ": is no MCAP file, which begins with the bytes 89 4D 43 41 50 30 0D 0A");
}

std::size_t RecordStream::fill(std::size_t size) {
  if (end_ - begin_ >= size) return end_ - begin_;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  while (end_ < size) {
    // Of a pipe, memory grows with what has come.
    const std::size_t wanted = std::max(std::min(size, end_ + (std::size_t{1} << 24)), kBufferBytes);
    if (buffer_.size() < wanted) buffer_.resize(wanted);
    std::size_t got = 0;
    try {
      got = file_.read(buffer_.data() + end_, buffer_.size() - end_);
    } catch (const std::system_error& error) {
      stop(error.code().message());
    }
    if (got == 0) break;
    end_ += got;
  }
  return end_ - begin_;
}

std::optional<Record> RecordStream::next() { return next(kMaxRecordBytes); }

std::optional<Record> RecordStream::nextBeginning(std::size_t at_most) { return next(at_most); }

std::optional<Record> RecordStream::next(std::uint64_t at_most) {
  if (!fault_.empty()) return std::nullopt;
  const std::size_t got = fill(kRecordPrefixBytes);
  if (!fault_.empty()) return std::nullopt;
  if (got == 0) {
    stop("it is cut off", true);  // a complete file ends with a footer, behind which nothing is read
    return std::nullopt;
  }
  Record record;
  record.start = position_;
  if (got >= kRecordPrefixBytes) {
    RecordReader prefix(std::span<const std::uint8_t>(buffer_).subspan(begin_, kRecordPrefixBytes));
    record.opcode = static_cast<Opcode>(prefix.u8());
    record.length = prefix.u64();
  }
  const std::uint64_t left = size() ? *size() - std::min(*size(), position_) : kMaxRecordBytes + kRecordPrefixBytes;
  if (got < kRecordPrefixBytes || (size() && record.length > left - kRecordPrefixBytes)) {
    stop("it is cut off", true);
    return std::nullopt;
  }
  if (record.length > kMaxRecordBytes) {
    stop("a record of " + std::to_string(record.length) + " bytes; it is damaged");
    return std::nullopt;
  }
  const auto wanted = static_cast<std::size_t>(std::min(record.length, at_most));
  if (fill(kRecordPrefixBytes + wanted) < kRecordPrefixBytes + wanted) {
    stop("it is cut off", true);
    return std::nullopt;
  }
  record.content = std::span(buffer_).subspan(begin_ + kRecordPrefixBytes, wanted);
  if (wanted == record.length) {
    begin_ += kRecordPrefixBytes + wanted;
    position_ += kRecordPrefixBytes + wanted;
  } else {
    seek(record.start + kRecordPrefixBytes + record.length);
  }
  return record;
}

std::span<const std::uint8_t> RecordStream::bytes(std::uint64_t position, std::size_t size) {
  seek(position);
  const std::size_t got = fill(size);
  return std::span(buffer_).subspan(begin_, std::min(got, size));
}

/// The buffered bytes stay in memory: a span of them is valid until the next read.
void RecordStream::seek(std::uint64_t position) {
  if (position >= position_ && position - position_ <= end_ - begin_) {
    begin_ += static_cast<std::size_t>(position - position_);
    position_ = position;
    return;
  }
  begin_ = end_ = 0;
  position_ = position;
  try {
    file_.seek(position);
  } catch (const std::system_error& error) {
    stop(error.code().message());
  }
}

void RecordStream::stop(const std::string& why, bool is_cut_off) {
  fault_ = why;
  is_cut_off_ = is_cut_off;
}

}  // namespace robosim::mcap
