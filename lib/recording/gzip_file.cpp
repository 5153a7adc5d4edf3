#include "recording/gzip_file.h"

#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <isa-l/igzip_lib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "base/error_list.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// The file that a recording to `file` would replace or make; follows a link, so that the link stays one.
fs::path checkedPath(const fs::path& file) {
  if (!file.has_filename()) {
    throw ConfigError(file.string() + ": is no name for a recording; give a file's, such as run.rawlog");
  }
  std::error_code ignored;
  const auto status = fs::status(file, ignored);
  if (!fs::exists(status)) return file;
  if (fs::is_directory(status)) {
    throw ConfigError(file.string() + ": is a folder; give the name of a file in it, such as " +
                      (file / "run.rawlog").string());
  }
  if (!fs::is_regular_file(status)) {
    throw ConfigError(file.string() +
                      ": is no ordinary file, and a recording would take its place; choose another name");
  }
  if (faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) {
    throw ConfigError(file.string() + ": must not be overwritten; choose another name, or make the file writable");
  }
  return fs::canonical(file);
}

std::string whyNotOpened(const fs::path& part, int error) {
  const fs::path folder = part.has_parent_path() ? part.parent_path() : ".";
  std::error_code ignored;
  if (error == ENOENT && fs::is_directory(folder, ignored)) error = EACCES;  // a folder of the system's, such as /proc
  switch (error) {
    case ENOENT:
      return "the folder " + folder.string() + " does not exist; make it, or record to another";
    case ENOTDIR:
      return folder.string() + " is no folder; record to one";
    case EACCES:
    case EPERM:
    case EROFS:
      return "the folder " + folder.string() + " is not writable (" + std::strerror(error) + "); record to another";
    default:
      return std::string(std::strerror(error)) + "; record to another file";
  }
}

/// Whether `descriptor` is open on what is called `part` now.
bool isStillCalled(const fs::path& part, int descriptor) {
  struct stat by_name, by_descriptor;
  return stat(part.c_str(), &by_name) == 0 && fstat(descriptor, &by_descriptor) == 0 &&
         by_name.st_dev == by_descriptor.st_dev && by_name.st_ino == by_descriptor.st_ino;
}

/// Opens `part` for this program alone, and empties it.
int openPart(const fs::path& part) {
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) throw ConfigError(part.string() + ": cannot be made: " + whyNotOpened(part, errno));
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 || !isStillCalled(part, descriptor)) {
    close(descriptor);
    throw ConfigError(part.string() + ": another program is recording there; record to another file");
  }
  if (ftruncate(descriptor, 0) != 0) {
    const int error = errno;
    close(descriptor);
    throw ConfigError(part.string() + ": cannot be emptied: " + whyNotOpened(part, error));
  }
  return descriptor;
}

/// @returns 0 or an errno.
int writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// ISA-L comes back with the upper halves of the vector registers in use, and until they are cleared every SSE
/// instruction waits for them: a simulation that recorded in its own thread ran at half its speed.
#if defined(__x86_64__)
__attribute__((target("avx"))) void clearUpperHalves() { _mm256_zeroupper(); }

void tidyVectorRegisters() {
  if (__builtin_cpu_supports("avx")) clearUpperHalves();
}
#else
void tidyVectorRegisters() {}
#endif

}  // namespace

struct GzipFile::Compressor {
  Compressor() {
    isal_deflate_init(&stream);
    stream.level = 0;  // a fifth larger than level 1, for half of its time
    stream.gzip_flag = IGZIP_GZIP;
    stream.flush = NO_FLUSH;
  }

  isal_zstream stream;
  std::uint8_t out[64 * 1024];
};

GzipFile::GzipFile(const fs::path& file)
    : path_(checkedPath(file)), part_(path_.string() + ".part"), compressor_(std::make_unique<Compressor>()) {
  descriptor_ = openPart(part_);
}

GzipFile::~GzipFile() { discard(); }

void GzipFile::write(std::span<const std::uint8_t> bytes) { compress(bytes, false); }

void GzipFile::commit() {
  compress({}, true);
  // Some disks tell only now that they are full.
  if (fsync(descriptor_) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) giveUp(errno);
  close(descriptor_);
  descriptor_ = -1;
}

void GzipFile::compress(std::span<const std::uint8_t> bytes, bool last) {
  if (descriptor_ < 0) throw RecordingError(path_.string() + ": this recording has been closed or given up");
  auto& stream = compressor_->stream;
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());  // only read: ISA-L's declaration forgets to say so
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  stream.end_of_stream = last;
  do {
    stream.next_out = compressor_->out;
    stream.avail_out = sizeof compressor_->out;
    [[maybe_unused]] const int status = isal_deflate(&stream);
    assert(status == COMP_OK);
    tidyVectorRegisters();
    const int error = writeAll(descriptor_, {compressor_->out, stream.next_out});
    if (error != 0) giveUp(error);
  } while (stream.avail_out == 0);
}

void GzipFile::giveUp(int error) {
  discard();
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw RecordingError(path_.string() + ": the recording could not be written: " + std::strerror(error) +
                       (full ? "; make room, or record elsewhere" : "; record elsewhere"));
}

void GzipFile::discard() {
  if (descriptor_ < 0) return;
  unlink(part_.c_str());
  close(descriptor_);
  descriptor_ = -1;
}

}  // namespace robosim
