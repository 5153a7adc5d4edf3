#include "recording/rawlog_reader.h"

#include "recording/observation_source.h"
#include "recording/picture_folder.h"

namespace robosim {

struct RawlogReader::Impl {
  std::unique_ptr<ObservationSource> source;
  std::filesystem::path pictures;
  bool is_of_ros = false;
};

RawlogReader::RawlogReader(const std::filesystem::path& file, Access access) : impl_(std::make_unique<Impl>()) {
  impl_->is_of_ros = isRosRecording(file);
  impl_->source = impl_->is_of_ros ? openRosRecording(file) : openRawlog(file, access);
  impl_->pictures = pictureFolderOf(file);
}

RawlogReader::~RawlogReader() = default;

mrpt::obs::CObservation::Ptr RawlogReader::next() { return impl_->source->next(); }
std::uint64_t RawlogReader::position() const { return impl_->source->position(); }
void RawlogReader::seek(std::uint64_t position) { impl_->source->seek(position); }
bool RawlogReader::isOfRos() const { return impl_->is_of_ros; }
const std::filesystem::path& RawlogReader::pictureFolder() const { return impl_->pictures; }
const std::optional<std::string>& RawlogReader::readError() const { return impl_->source->report().error; }
bool RawlogReader::endsEarly() const { return impl_->source->report().ends_early; }
bool RawlogReader::isDamaged() const { return impl_->source->report().is_damaged; }
std::uint64_t RawlogReader::entries() const { return impl_->source->report().entries; }
std::uint64_t RawlogReader::skippedEntries() const { return impl_->source->report().skipped_entries; }
const std::vector<std::string>& RawlogReader::unread() const { return impl_->source->report().unread; }
const std::vector<std::string>& RawlogReader::assumptions() const { return impl_->source->report().assumptions; }

}  // namespace robosim
