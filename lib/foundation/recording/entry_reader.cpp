#include "recording/entry_reader.h"

#include <exception>
#include <stdexcept>
#include <utility>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include "recording/picture_guard.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::serialization::CSerializable;

/// Maximum size of a single allocation while an entry is read: ten times the largest images and point clouds.
constexpr std::size_t kMaxPieceBytes = std::size_t{256} << 20;
/// Maximum memory of one entry: one such allocation, and as much again for its other data.
constexpr std::size_t kMaxEntryBytes = 2 * kMaxPieceBytes;

/// A damaged entry that requests more than kMaxPieceBytes.
class EntryTooLarge : public std::exception {
 public:
  const char* what() const noexcept override { return kEntryTooLarge; }
};

}  // namespace

const char* const kEntryTooLarge = "the next entry requests more than 256 MiB; it is damaged";

/// An MRPT archive that reads decompressed bytes.
class EntryReader::Archive : public mrpt::serialization::CArchive {
 public:
  explicit Archive(Read read) : read_(std::move(read)) {}

  std::string getArchiveDescription() const override { return "rawlog"; }
  /// Whether a read of more than kMaxPieceBytes was requested.
  bool hasExceededLimit() const { return has_exceeded_limit_; }
  /// Cause for which a picture ended the reading of an entry; empty for none.
  const std::string& refusal() const { return refusal_; }
  const PictureGuard& pictures() const { return pictures_; }
  /// Prepares for another entry.
  void beginEntry() {
    has_exceeded_limit_ = false;
    refusal_.clear();
    pictures_.beginEntry();
  }

 protected:
  std::size_t write(const void*, std::size_t) override { throw std::logic_error("an EntryReader only reads"); }
  std::size_t read(void* to, std::size_t size) override {
    has_exceeded_limit_ = has_exceeded_limit_ || size > kMaxPieceBytes;
    if (has_exceeded_limit_) throw EntryTooLarge();
    const std::size_t got = read_(to, size);
    try {
      if (got == size && size > 0) pictures_.inspect(static_cast<std::uint8_t*>(to), size);
    } catch (const std::runtime_error& error) {
      refusal_ = error.what();  // MRPT replaces the exception by one of its own
      throw;
    }
    return got;
  }

 private:
  Read read_;
  PictureGuard pictures_;
  bool has_exceeded_limit_ = false;
  std::string refusal_;
};

EntryReader::EntryReader(Read read) : bound_(kMaxEntryBytes), archive_(std::make_unique<Archive>(std::move(read))) {}

EntryReader::~EntryReader() = default;

RawlogEntry EntryReader::next() {
  archive_->beginEntry();
  const auto object = archive_->ReadObject<CSerializable>();
  RawlogEntry entry;
  entry.fault = archive_->pictures().fault();
  const auto add = [&](const CObservation::Ptr& observation) {
    if (!archive_->pictures().isDamaged(*observation)) entry.objects.push_back(observation);
  };
  if (const auto single = std::dynamic_pointer_cast<CObservation>(object)) {
    add(single);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) add(observation);
  } else if (std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
    entry.objects.push_back(object);
  } else {
    entry.is_skipped = true;
  }
  return entry;
}

std::string EntryReader::failure() const { return archive_->hasExceededLimit() ? kEntryTooLarge : archive_->refusal(); }

}  // namespace robosim
