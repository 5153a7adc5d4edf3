#include "recording/member_decoder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <isa-l/igzip_lib.h>

#include "base/input_file.h"
#include "base/vector_registers.h"
#include "recording/gzip_members.h"

namespace robosim {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Whether the sizes that a header states are possible: a code of deflate has at most 15 bits per byte of the content.
bool isPossible(const MemberHeader& header) {
  constexpr std::uint64_t kFrameBytes = 4096;
  return header.unpacked <= MemberDecoder::kMaxContentBytes &&
         header.packed <= 2 * std::uint64_t{header.unpacked} + kFrameBytes;
}

/// Fewer bytes at the end of the file.
std::size_t readSome(InputFile& file, void* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const std::size_t got = file.read(static_cast<std::uint8_t*>(to) + done, size - done);
    if (got == 0) break;
    done += got;
  }
  return done;
}

/// Content of a member. @return whether it is whole and has the size and the checksum that it says
bool unpack(const Bytes& packed, std::uint32_t size, Bytes& content) {
  constexpr std::uint32_t kSpare = 8;  // so that the end of the content is read when it is full
  content.resize(size + kSpare);
  inflate_state state{};
  isal_inflate_init(&state);
  state.crc_flag = ISAL_GZIP_NO_HDR_VER;
  state.next_in = const_cast<std::uint8_t*>(packed.data()) + MemberHeader::kBytes;  // only read
  state.avail_in = static_cast<std::uint32_t>(packed.size() - MemberHeader::kBytes);
  state.next_out = content.data();
  state.avail_out = size + kSpare;
  const int status = isal_inflate(&state);
  clearVectorRegisters();
  content.resize(size);
  return status == ISAL_DECOMP_OK && state.block_state == ISAL_BLOCK_FINISH && state.total_out == size &&
         state.avail_in == 0;
}

/// The entries of a member's content; nullopt if not all can be read.
std::optional<std::deque<RawlogEntry>> entriesOf(std::span<const std::uint8_t> content, std::uint64_t position) {
  std::size_t at = 0;
  EntryReader reader([&](void* to, std::size_t size) {
    size = std::min(size, content.size() - at);
    std::memcpy(to, content.data() + at, size);
    at += size;
    return size;
  });
  reader.measure();
  std::deque<RawlogEntry> entries;
  try {
    const MemoryBound::Hold hold(reader.bound());
    while (at < content.size()) {
      const std::uint64_t begin = position + at;
      entries.push_back(reader.next());
      entries.back().position = begin;
    }
  } catch (const std::exception&) {  // which a reader of the whole file reports
    return std::nullopt;
  }
  return entries;
}

}  // namespace

struct MemberDecoder::Impl {
  /// A member that is or was decoded.
  struct Slot {
    MemberPlace place;
    MemberHeader header;
    Bytes packed;
    std::optional<std::deque<RawlogEntry>> entries;  ///< nullopt if it has errors
    bool is_done = false;
  };

  Impl(std::unique_ptr<InputFile> of, const MemberPlace& from) : file(std::move(of)), place(from) {}

  std::shared_ptr<Slot> readMember();
  bool hasRoom() const { return slots.size() < max_slots && waiting_bytes < kMaxWaitingBytes; }
  void prepareAll(std::deque<RawlogEntry>& entries) const;
  void work();

  std::mutex mutex;
  std::condition_variable is_room, is_done;
  std::unique_ptr<InputFile> file;
  Prepare prepare;
  MemberPlace place;  ///< of the next member
  bool is_over = false, is_cancelled = false;
  std::deque<std::shared_ptr<Slot>> slots;  ///< not yet taken, in their order
  std::size_t max_slots = 2;
  std::uint64_t waiting_bytes = 0;  ///< of the content of the members in slots
  std::deque<RawlogEntry> entries;  ///< of the member that is taken
  std::optional<MemberPlace> end;
  std::vector<std::thread> threads;
};

/// Reads the next member into a slot, and skips pages of the index before it. @return null at the end. @pre locked
std::shared_ptr<MemberDecoder::Impl::Slot> MemberDecoder::Impl::readMember() {
  try {
    while (true) {
      std::array<std::uint8_t, MemberHeader::kBytes> head{};
      if (readSome(*file, head.data(), head.size()) != head.size()) return nullptr;
      if (const auto size = IndexPage::sizeOf(head)) {
        if (*size < head.size()) return nullptr;
        Bytes bytes(head.begin(), head.end());
        bytes.resize(*size);
        if (readSome(*file, bytes.data() + head.size(), *size - head.size()) != *size - head.size()) return nullptr;
        const auto page = IndexPage::parse(bytes);
        if (!page || page->position != place.packed) return nullptr;
        place.packed += *size;
        continue;
      }
      const auto header = MemberHeader::parse(head);
      if (!header || !isPossible(*header)) return nullptr;
      if (header->packed > file->size().value_or(0) - place.packed) return nullptr;  // it is cut off
      auto slot = std::make_shared<Slot>();
      slot->place = place;
      slot->header = *header;
      slot->packed.resize(header->packed);
      std::copy(head.begin(), head.end(), slot->packed.begin());
      const std::size_t left = header->packed - head.size();
      if (readSome(*file, slot->packed.data() + head.size(), left) != left) return nullptr;
      slots.push_back(slot);
      waiting_bytes += header->unpacked;
      place.packed += header->packed;
      place.unpacked += header->unpacked;
      return slot;
    }
  } catch (const std::exception&) {  // of the file, which a reader of the whole file reports, or of the memory
    return nullptr;
  }
}

void MemberDecoder::Impl::prepareAll(std::deque<RawlogEntry>& entries_of_member) const {
  for (auto& entry : entries_of_member) {
    for (const auto& object : entry.objects) {
      auto& prepared = entry.prepared.emplace_back();
      const auto* const observation = dynamic_cast<const mrpt::obs::CObservation*>(object.get());
      if (!observation) continue;
      try {
        prepared = prepare(*observation);
      } catch (const std::exception&) {  // which its user meets as well
        prepared.reset();
      }
    }
  }
}

void MemberDecoder::Impl::work() {
  Bytes content;
  std::unique_lock lock(mutex);
  while (true) {
    is_room.wait(lock, [this] { return is_cancelled || is_over || hasRoom(); });
    if (is_cancelled || is_over) return;
    const auto slot = readMember();
    if (!slot) {
      is_over = true;
      is_room.notify_all();
      is_done.notify_all();
      return;
    }
    lock.unlock();
    try {
      if (unpack(slot->packed, slot->header.unpacked, content)) {
        slot->entries = entriesOf(content, slot->place.unpacked);
      }
      if (slot->entries && prepare) prepareAll(*slot->entries);
    } catch (const std::exception&) {  // such as of the memory: the member is read otherwise
      slot->entries.reset();
    }
    lock.lock();
    slot->packed = {};
    slot->is_done = true;
    is_done.notify_all();
  }
}

std::unique_ptr<InputFile> MemberDecoder::open(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return nullptr;
  auto file = std::make_unique<InputFile>(path);
  std::array<std::uint8_t, MemberHeader::kBytes> head{};
  try {
    const std::size_t size = readSome(*file, head.data(), head.size());
    return MemberHeader::parse(std::span(head).first(size)) ? std::move(file) : nullptr;
  } catch (const std::system_error&) {  // which a reader of the whole file reports
    return nullptr;
  }
}

MemberDecoder::MemberDecoder(std::unique_ptr<InputFile> file, const MemberPlace& from, int threads, Prepare prepare)
    : impl_(std::make_unique<Impl>(std::move(file), from)) {
  impl_->prepare = std::move(prepare);
  impl_->max_slots = static_cast<std::size_t>(threads) + 2;
  try {
    impl_->file->seek(from.packed);
  } catch (const std::system_error&) {
    impl_->is_over = true;
  }
  try {
    for (int i = 0; i < threads; ++i) impl_->threads.emplace_back([this] { impl_->work(); });
  } catch (const std::exception&) {  // the system has no further ones
  }
  if (impl_->threads.empty()) impl_->is_over = true;
}

MemberDecoder::~MemberDecoder() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->is_cancelled = true;
  }
  impl_->is_room.notify_all();
  for (auto& thread : impl_->threads) thread.join();
}

std::optional<RawlogEntry> MemberDecoder::next() {
  while (impl_->entries.empty()) {
    if (impl_->end) return std::nullopt;
    std::unique_lock lock(impl_->mutex);
    impl_->is_done.wait(lock, [this] { return impl_->slots.empty() ? impl_->is_over : impl_->slots.front()->is_done; });
    if (impl_->slots.empty()) {
      impl_->end = impl_->place;
      return std::nullopt;
    }
    const auto slot = std::move(impl_->slots.front());
    impl_->slots.pop_front();
    impl_->waiting_bytes -= slot->header.unpacked;
    if (!slot->entries) {
      impl_->end = slot->place;
      impl_->is_over = true;
      impl_->is_room.notify_all();
      return std::nullopt;
    }
    impl_->entries = std::move(*slot->entries);
    lock.unlock();
    impl_->is_room.notify_all();  // after a large member, for several ones
  }
  RawlogEntry entry = std::move(impl_->entries.front());
  impl_->entries.pop_front();
  return entry;
}

MemberPlace MemberDecoder::end() const { return *impl_->end; }

}  // namespace robosim
