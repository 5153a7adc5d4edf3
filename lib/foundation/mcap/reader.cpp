#include "mcap/reader.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "mcap/compression.h"
#include "mcap/record_stream.h"

namespace robosim::mcap {
namespace {

/// Bytes of a chunk's record before its compression's name, and the greatest length of a name that is looked at.
constexpr std::size_t kChunkBeginning = 8 + 8 + 8 + 4 + 4 + 64;
/// Bytes of an attachment that are read for its name.
constexpr std::size_t kAttachmentBeginning = 4096;
/// Unpacked chunks that are kept beside the present one, for readers that go back and forth, as in the order of other
/// times than that of the file.
constexpr std::size_t kKeptChunks = 8;
constexpr std::size_t kMaxKeptBytes = std::size_t{1} << 26;

Chunk readChunk(RecordReader& reader) {
  Chunk chunk;
  chunk.start_time = reader.u64();
  chunk.end_time = reader.u64();
  chunk.uncompressed_size = reader.u64();
  chunk.uncompressed_crc = reader.u32();
  chunk.compression = reader.text();
  return chunk;
}

}  // namespace

struct Reader::Impl {
  explicit Impl(const std::filesystem::path& file) : stream(file) {}

  std::optional<Message> next();
  std::optional<Message> nextInChunk();
  std::optional<Message> take(const Record& record);
  void openChunk(const Record& record);
  bool takeKeptChunk(std::uint64_t record);
  void keepChunk();
  void add(Opcode opcode, std::span<const std::uint8_t> content);
  std::optional<Message> messageOf(std::span<const std::uint8_t> content);
  bool readSummary();
  void scan();
  template <typename Read>
  auto recordAt(std::uint64_t position, Opcode opcode, const char* what, const Read& read);

  RecordStream stream;
  Header header;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<std::uint8_t> chunk;  ///< the records of the present one
  std::size_t chunk_at = 0;         ///< position in it
  std::uint64_t chunk_record = 0;   ///< its record in the file
  std::uint64_t chunk_end = 0;      ///< of that record
  struct KeptChunk {
    std::uint64_t record = 0, end = 0;
    std::vector<std::uint8_t> records;
  };
  std::deque<KeptChunk> kept_chunks;  ///< the latest one first
  Place place;
  std::uint64_t from_ns = 0;
  bool is_over = false;
  std::optional<Contents> contents;
};

void Reader::Impl::add(Opcode opcode, std::span<const std::uint8_t> content) {
  if (opcode == Opcode::schema) {
    Schema schema = read<Schema>(content);
    const std::uint16_t id = schema.id;
    const auto [known, is_new] = schemas.try_emplace(id, std::move(schema));
    if (!is_new && known->second != read<Schema>(content)) {
      throw RecordError("two different schemas have the id " + std::to_string(id));
    }
  } else if (opcode == Opcode::channel) {
    Channel channel = read<Channel>(content);
    const std::uint16_t id = channel.id;
    if (channel.schema_id != 0 && schemas.count(channel.schema_id) == 0) {
      throw RecordError("channel \"" + channel.topic + "\" has the schema " + std::to_string(channel.schema_id) +
                        ", which is not in the file before it");
    }
    const auto [known, is_new] = channels.try_emplace(id, std::move(channel));
    if (!is_new && known->second != read<Channel>(content)) {
      throw RecordError("two different channels have the id " + std::to_string(id));
    }
  }
}

std::optional<Message> Reader::Impl::messageOf(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Message message;
  message.channel = reader.u16();
  message.sequence = reader.u32();
  message.log_time_ns = reader.u64();
  message.publish_time_ns = reader.u64();
  message.data = reader.rest();
  if (channels.count(message.channel) == 0) {
    throw RecordError("a message has the channel " + std::to_string(message.channel) +
                      ", which is not in the file before it");
  }
  return message.log_time_ns >= from_ns ? std::make_optional(message) : std::nullopt;
}

void Reader::Impl::openChunk(const Record& record) {
  RecordReader reader(record.content);
  const Chunk head = readChunk(reader);
  const auto packed = reader.bytes(reader.u64());
  auto records = unpack(packed, head.compression, head.uncompressed_size);
  if (head.uncompressed_crc != 0 && crcOf(records) != head.uncompressed_crc) {
    throw RecordError("a chunk does not match its checksum");
  }
  chunk = std::move(records);
  chunk_at = 0;
  chunk_record = record.start;
  chunk_end = record.start + kRecordPrefixBytes + record.length;
}

/// Makes a chunk the present one, if it is the present one or kept. @returns whether it is
bool Reader::Impl::takeKeptChunk(std::uint64_t record) {
  if (!chunk.empty() && chunk_record == record) return true;
  keepChunk();
  const auto kept = std::find_if(kept_chunks.begin(), kept_chunks.end(),
                                 [record](const KeptChunk& one) { return one.record == record; });
  if (kept == kept_chunks.end()) return false;
  chunk = std::move(kept->records);
  chunk_record = record;
  chunk_end = kept->end;
  kept_chunks.erase(kept);
  return true;
}

/// Moves the present chunk to those that are kept.
void Reader::Impl::keepChunk() {
  if (!chunk.empty()) kept_chunks.push_front({chunk_record, chunk_end, std::move(chunk)});
  chunk.clear();
  std::size_t bytes = 0, count = 0;
  while (count < kept_chunks.size() && count < kKeptChunks) {
    bytes += kept_chunks[count].records.size();
    if (bytes > kMaxKeptBytes) break;
    ++count;
  }
  kept_chunks.resize(count);
}

std::optional<Message> Reader::Impl::nextInChunk() {
  while (chunk_at < chunk.size()) {
    const std::size_t start = chunk_at;
    RecordReader reader(std::span<const std::uint8_t>(chunk).subspan(chunk_at));
    const auto opcode = static_cast<Opcode>(reader.u8());
    const auto content = reader.bytes(reader.u64());
    chunk_at += kRecordPrefixBytes + content.size();
    if (opcode != Opcode::message) {
      add(opcode, content);
      continue;
    }
    if (auto message = messageOf(content)) {
      place = {chunk_record, start};
      return message;
    }
  }
  return std::nullopt;
}

/// @returns the message, if the record is one or contains one
std::optional<Message> Reader::Impl::take(const Record& record) {
  switch (record.opcode) {
    case Opcode::header:
      header = read<Header>(record.content);
      break;
    case Opcode::message:
      place = {record.start, 0};
      return messageOf(record.content);
    case Opcode::chunk:
      openChunk(record);
      return nextInChunk();
    case Opcode::data_end:
    case Opcode::footer:
      is_over = true;
      break;
    default:
      add(record.opcode, record.content);
  }
  return std::nullopt;
}

std::optional<Message> Reader::Impl::next() {
  if (is_over) return std::nullopt;
  std::uint64_t start = chunk_record;
  try {
    if (auto message = nextInChunk()) return message;
    while (!is_over) {
      const auto record = stream.next();
      if (!record) break;
      start = record->start;
      if (auto message = take(*record)) return message;
    }
  } catch (const RecordError& error) {
    stream.stop(std::string(error.what()) + " (the record at byte " + std::to_string(start) + ")");
  }
  is_over = true;
  return std::nullopt;
}

bool Reader::Impl::readSummary() {
  constexpr std::size_t kTail = kRecordPrefixBytes + kFooterBytes + kMagic.size();
  const std::uint64_t size = *stream.size();
  if (size < kMagic.size() + kTail) return false;
  const std::uint64_t footer_start = size - kTail;
  const auto tail = stream.bytes(footer_start, kTail);
  if (tail.size() < kTail) return false;
  RecordReader reader(tail);
  if (static_cast<Opcode>(reader.u8()) != Opcode::footer || reader.u64() != kFooterBytes) return false;
  const Footer footer = read<Footer>(reader.bytes(kFooterBytes));
  const auto magic = reader.rest();
  if (!std::equal(magic.begin(), magic.end(), kMagic.begin(),
                  [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); })) {
    return false;
  }
  if (footer.summary_start == 0 || footer.summary_start > footer_start) return false;
  // The checksum covers the footer without the checksum.
  const std::uint64_t covered = size - kMagic.size() - 4 - footer.summary_start;
  const auto summary = stream.bytes(footer.summary_start, covered);
  if (summary.size() < covered || (footer.summary_crc != 0 && crcOf(summary) != footer.summary_crc)) return false;

  Contents read;
  read.has_summary = true;
  RecordReader records(summary.first(footer_start - footer.summary_start));
  while (!records.rest().empty()) {
    const auto opcode = static_cast<Opcode>(records.u8());
    const auto content = records.bytes(records.u64());
    switch (opcode) {
      case Opcode::statistics:
        read.statistics = mcap::read<Statistics>(content);
        break;
      case Opcode::chunk_index:
        read.chunks.push_back(mcap::read<ChunkIndex>(content));
        break;
      case Opcode::attachment_index:
        read.attachments.push_back(mcap::read<AttachmentIndex>(content));
        break;
      case Opcode::metadata_index:
        read.metadata.push_back(mcap::read<MetadataIndex>(content));
        break;
      default:
        add(opcode, content);
    }
  }
  std::stable_sort(read.chunks.begin(), read.chunks.end(),
                   [](const ChunkIndex& a, const ChunkIndex& b) { return a.chunk_start < b.chunk_start; });
  contents = std::move(read);
  return true;
}

/// Collects the contents of a file without a valid summary.
void Reader::Impl::scan() {
  Contents& found = contents.emplace();  // also of a file with a damaged record, what is before it
  stream.seek(kMagic.size());
  while (const auto record = stream.nextBeginning(kAttachmentBeginning)) {
    const std::uint64_t length = kRecordPrefixBytes + record->length;
    if (record->opcode == Opcode::chunk) {
      RecordReader reader(record->content.first(std::min(record->content.size(), kChunkBeginning)));
      const Chunk head = readChunk(reader);
      ChunkIndex index;
      index.start_time = head.start_time;
      index.end_time = head.end_time;
      index.chunk_start = record->start;
      index.chunk_length = length;
      index.compression = head.compression;
      index.compressed_size = reader.u64();
      index.uncompressed_size = head.uncompressed_size;
      found.chunks.push_back(std::move(index));
    } else if (record->opcode == Opcode::attachment) {
      const Attachment attachment = readAttachment(record->content, false);
      RecordReader reader(record->content);
      const std::uint64_t head = 8 + 8 + 4 + attachment.name.size() + 4 + attachment.media_type.size();
      reader.bytes(head);
      found.attachments.push_back({record->start, length, attachment.log_time, attachment.create_time, reader.u64(),
                                   attachment.name, attachment.media_type});
    } else if (record->opcode == Opcode::metadata) {
      found.metadata.push_back({record->start, length, RecordReader(record->content).text()});
    } else if (record->opcode == Opcode::data_end || record->opcode == Opcode::footer) {
      break;
    }
  }
}

template <typename Read>
auto Reader::Impl::recordAt(std::uint64_t position, Opcode opcode, const char* what, const Read& read) {
  const std::uint64_t before = stream.position();
  stream.seek(position);
  const auto record = stream.next();
  if (!record || record->opcode != opcode) {
    const std::string why = record ? "there is another record" : stream.fault();
    stream.stop("");
    stream.seek(before);
    throw RecordError(std::string("the ") + what + " at byte " + std::to_string(position) + " cannot be read: " + why);
  }
  auto result = read(record->content);
  stream.seek(before);
  return result;
}

Reader::Reader(const std::filesystem::path& file) : impl_(std::make_unique<Impl>(file)) {
  const auto first = impl_->stream.next();
  if (!first || first->opcode != Opcode::header) {
    if (first) impl_->stream.stop("the first record is no header");
    impl_->is_over = true;
    return;
  }
  try {
    impl_->take(*first);
  } catch (const RecordError& error) {
    impl_->stream.stop(error.what());
    impl_->is_over = true;
  }
}

Reader::~Reader() = default;

const Header& Reader::header() const { return impl_->header; }
const std::map<std::uint16_t, Schema>& Reader::schemas() const { return impl_->schemas; }
const std::map<std::uint16_t, Channel>& Reader::channels() const { return impl_->channels; }
std::optional<Message> Reader::next() { return impl_->next(); }
Reader::Place Reader::place() const { return impl_->place; }

void Reader::seek(const Place& place) {
  impl_->is_over = false;
  impl_->from_ns = 0;
  impl_->stream.stop("");
  if (!impl_->takeKeptChunk(place.record)) {
    impl_->chunk_at = 0;
    impl_->stream.seek(place.record);
    if (place.in_chunk == 0) return;  // a message that is in no chunk, or the beginning of a chunk
    try {
      const auto record = impl_->stream.next();
      if (!record || record->opcode != Opcode::chunk) throw RecordError("there is no chunk");
      impl_->openChunk(*record);
    } catch (const RecordError& error) {
      impl_->stream.stop(std::string(error.what()) + " (the record at byte " + std::to_string(place.record) + ")");
      impl_->is_over = true;
      return;
    }
  } else {
    impl_->stream.seek(impl_->chunk_end);  // the records after the chunk follow
  }
  impl_->chunk_at = std::min(static_cast<std::size_t>(place.in_chunk), impl_->chunk.size());
}

void Reader::seekTime(std::uint64_t time_ns) {
  const Contents& found = contents();
  std::uint64_t start = kMagic.size();
  if (!found.chunks.empty()) {
    const auto chunk = std::find_if(found.chunks.begin(), found.chunks.end(),
                                    [&](const ChunkIndex& index) { return index.end_time >= time_ns; });
    start = chunk == found.chunks.end() ? found.chunks.back().chunk_start : chunk->chunk_start;
  }
  // Without a summary, schemas and channels are in the chunks before.
  if (!found.has_summary) start = kMagic.size();
  impl_->chunk.clear();
  impl_->chunk_at = 0;
  impl_->is_over = false;
  impl_->stream.stop("");
  impl_->stream.seek(start);
  impl_->from_ns = time_ns;
}

const Contents& Reader::contents() {
  if (impl_->contents) return *impl_->contents;
  const std::uint64_t before = impl_->stream.position();
  const std::string fault = impl_->stream.fault();
  const bool is_cut_off = impl_->stream.isCutOff();
  impl_->stream.stop("");
  bool has_summary = false;
  try {
    has_summary = impl_->readSummary();
  } catch (const RecordError&) {  // a damaged summary
  }
  try {
    if (!has_summary) impl_->scan();
  } catch (const RecordError&) {
  }
  impl_->stream.stop(fault, is_cut_off);
  impl_->stream.seek(before);
  return *impl_->contents;
}

Attachment Reader::attachment(const AttachmentIndex& index) {
  return impl_->recordAt(index.offset, Opcode::attachment, "attachment",
                         [](std::span<const std::uint8_t> content) { return readAttachment(content); });
}

Metadata Reader::metadata(const MetadataIndex& index) {
  return impl_->recordAt(index.offset, Opcode::metadata, "metadata record", read<Metadata>);
}

const std::string& Reader::fault() const { return impl_->stream.fault(); }
bool Reader::isCutOff() const { return impl_->stream.isCutOff(); }

}  // namespace robosim::mcap
