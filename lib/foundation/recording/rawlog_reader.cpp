#include "recording/rawlog_reader.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/file_kind.h"
#include "recording/observation_source.h"
#include "recording/picture_folder.h"

namespace robosim {

struct RawlogReader::Impl {
  std::unique_ptr<ObservationSource> source;
  std::filesystem::path pictures;
  bool is_foreign = false;
};

int threadsForReading() {
  constexpr unsigned kMost = 16;
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, kMost));
}

RawlogReader::RawlogReader(const std::filesystem::path& file, Access access, int threads)
    : impl_(std::make_unique<Impl>()) {
  const bool is_of_carmen = kindOfFile(file) == FileKind::carmen_log;
  const bool is_of_ros = !is_of_carmen && isRosRecording(file);
  impl_->is_foreign = is_of_carmen || is_of_ros;
  impl_->source = is_of_carmen ? openCarmenLog(file, access)
                  : is_of_ros  ? openRosRecording(file)
                               : openRawlog(file, access, threads);
  impl_->pictures = pictureFolderOf(file);
}

RawlogReader::~RawlogReader() = default;

mrpt::obs::CObservation::Ptr RawlogReader::next() { return impl_->source->next(); }
void RawlogReader::prepareWith(const std::function<std::shared_ptr<void>(const mrpt::obs::CObservation&)>& prepare) {
  impl_->source->prepareWith(prepare);
}
std::shared_ptr<void> RawlogReader::prepared() const { return impl_->source->prepared(); }
std::uint64_t RawlogReader::position() const { return impl_->source->position(); }
void RawlogReader::seek(std::uint64_t position) { impl_->source->seek(position); }
bool RawlogReader::isForeign() const { return impl_->is_foreign; }
const std::filesystem::path& RawlogReader::pictureFolder() const { return impl_->pictures; }
const std::optional<std::string>& RawlogReader::readError() const { return impl_->source->report().error; }
bool RawlogReader::endsEarly() const { return impl_->source->report().ends_early; }
bool RawlogReader::isDamaged() const { return impl_->source->report().is_damaged; }
std::uint64_t RawlogReader::entries() const { return impl_->source->report().entries; }
std::uint64_t RawlogReader::skippedEntries() const { return impl_->source->report().skipped_entries; }
const std::vector<std::string>& RawlogReader::unread() const { return impl_->source->report().unread; }
const std::vector<std::string>& RawlogReader::assumptions() const { return impl_->source->report().assumptions; }

}  // namespace robosim
