#include "base/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 64 * 1024;

/// The file that is replaced or created; follows links, so that a link is kept.
fs::path checkedPath(const fs::path& file) {
  if (!file.has_filename()) throw ConfigError(file.string() + ": is no name for a file; give one");
  std::error_code ignored;
  const auto status = fs::status(file, ignored);
  if (!fs::exists(status)) return file;
  if (fs::is_directory(status)) throw ConfigError(file.string() + ": is a folder; name a file in it");
  if (!fs::is_regular_file(status)) {
    throw ConfigError(file.string() + ": is not a regular file, and would be replaced; choose another name");
  }
  if (faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) {
    throw ConfigError(file.string() + ": must not be overwritten; choose another name, or make the file writable");
  }
  return fs::canonical(file);
}

std::string whyNotOpened(const fs::path& file, int error) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;
  if (error == ENOENT && fs::is_directory(folder, ignored)) error = EACCES;  // a system folder such as /proc
  switch (error) {
    case ENOENT:
      return "the folder " + folder.string() + " does not exist; create it, or choose another";
    case ENOTDIR:
      return folder.string() + " is no folder; choose one";
    case EACCES:
    case EPERM:
    case EROFS:
      return "the folder " + folder.string() + " is not writable (" + std::strerror(error) + "); choose another";
    default:
      return std::string(std::strerror(error)) + "; choose another file";
  }
}

/// Whether `descriptor` refers to the file that is currently named `part`.
bool hasName(const fs::path& part, int descriptor) {
  struct stat by_name, by_descriptor;
  return stat(part.c_str(), &by_name) == 0 && fstat(descriptor, &by_descriptor) == 0 &&
         by_name.st_dev == by_descriptor.st_dev && by_name.st_ino == by_descriptor.st_ino;
}

fs::path partOf(const fs::path& file) { return file.string() + ".part"; }

/// Opens and locks a file's .part, and truncates it.
int openPart(const fs::path& file) {
  const fs::path part = partOf(file);
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) throw ConfigError(file.string() + ": cannot be created: " + whyNotOpened(file, errno));
  // A file system without locks has other errors than EWOULDBLOCK.
  if ((flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) || !hasName(part, descriptor)) {
    close(descriptor);
    throw ConfigError(part.string() + ": another program is writing there; choose another file");
  }
  if (ftruncate(descriptor, 0) != 0) {
    const int error = errno;
    close(descriptor);
    throw ConfigError(file.string() + ": cannot be created: " + whyNotOpened(file, error));
  }
  return descriptor;
}

/// @returns 0 or an errno.
int writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& file, IfKilled if_killed)
    : file_(checkedPath(file)), part_(partOf(file_)), descriptor_(openPart(file_)) {
  if (if_killed == IfKilled::remove_part) partial_ = std::make_unique<PartialFile>(part_.string());
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  unlink(part_.c_str());
  close(descriptor_);
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() >= kBufferBytes) flush();
  if (bytes.size() < kBufferBytes) {
    buffer_.append(bytes);
  } else if (error_ == 0) {
    error_ = writeAll(descriptor_, bytes);
  }
}

void AtomicFile::flush() {
  if (error_ == 0) error_ = writeAll(descriptor_, buffer_);
  buffer_.clear();
}

void AtomicFile::finish() {
  flush();
  // Some file systems report a full disk only here.
  if (error_ == 0 && !is_finished_ && fsync(descriptor_) != 0) error_ = errno;
  is_finished_ = true;
  throwIfFailed();
}

void AtomicFile::commit() {
  finish();
  if (std::rename(part_.c_str(), file_.c_str()) != 0) error_ = errno;
  throwIfFailed();
  close(descriptor_);
  descriptor_ = -1;
  partial_.reset();
}

void AtomicFile::throwIfFailed() const {
  if (error_ == 0) return;
  throw std::runtime_error(file_.string() + ": cannot be written (" + std::strerror(error_) +
                           "); choose another place");
}

void checkWritable(const fs::path& file) { AtomicFile{file}; }

}  // namespace robosim
