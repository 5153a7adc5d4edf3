#include "recording/recording_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include "recording/recording_error.h"

namespace robosim {

RecordingFile::RecordingFile(const std::filesystem::path& file)
    : file_(std::in_place, file, AtomicFile::IfKilled::keep_part), path_(file_->path()) {}

void RecordingFile::checkOpen() const {
  if (!file_) throw RecordingError(path_.string() + ": this recording has been closed or discarded");
}

void RecordingFile::write(std::span<const std::uint8_t> bytes) {
  checkOpen();
  file_->write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (file_->error() != 0) fail();
}

void RecordingFile::finish() {
  checkOpen();
  check([this] { file_->finish(); });
}

void RecordingFile::commit() {
  checkOpen();
  check([this] { file_->commit(); });
  file_.reset();
}

template <typename Act>
void RecordingFile::check(const Act& act) {
  try {
    act();
  } catch (const std::runtime_error&) {
    fail();
  }
}

void RecordingFile::fail() {
  const int error = file_->error();
  file_.reset();
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw RecordingError(path_.string() + ": the recording could not be written: " + std::strerror(error) +
                       (full ? "; free disk space, or record elsewhere" : "; record elsewhere"));
}

}  // namespace robosim
