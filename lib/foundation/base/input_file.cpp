#include "base/input_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error_list.h"
#include "base/interrupt.h"

namespace robosim {
namespace {

std::string whyNotOpened(int error) {
  switch (error) {
    case ENOENT:
      return "no such file; check the path";
    case ENOTDIR:
      return "a part of the path is a file, not a directory; check the path";
    case ELOOP:
      return "its symbolic links form a loop; name another file";
    case ENAMETOOLONG:
      return "the path is too long; check it";
    case EACCES:
    case EPERM:
      return "cannot be opened for reading; check its permissions";
    default:
      return std::string("cannot be opened for reading (") + std::strerror(error) + ")";
  }
}

/// Why a file of another type than those of InputFile is refused; empty for the accepted types.
std::string refusal(const struct stat& about) {
  const std::string fix = "; name a regular file or a pipe";
  switch (about.st_mode & S_IFMT) {
    case S_IFREG:
    case S_IFIFO:
      return "";
    case S_IFDIR:
      return "is a directory; name a file in it";
    case S_IFSOCK:
      return "is a socket" + fix;
    case S_IFBLK:
      return "is a block device" + fix;
    default:
      return "is a character device" + fix;
  }
}

bool isTerminal(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return false;
  const bool is_terminal = isatty(descriptor) == 1;
  close(descriptor);
  return is_terminal;
}

/// Opening a device can have side effects; only terminals are opened, because standard input may be one.
bool mayBeTerminal(const std::filesystem::path& file, const struct stat& about) {
  if (!S_ISCHR(about.st_mode)) return false;
  struct stat input {};
  const bool is_input = fstat(STDIN_FILENO, &input) == 0 && input.st_rdev == about.st_rdev && S_ISCHR(input.st_mode);
  return is_input && isatty(STDIN_FILENO) == 1 && isTerminal(file);
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& file) : name_(file.string()) {
  const auto fail = [&](const std::string& why) { throw ConfigError(name_ + ": " + why); };
  struct stat about {};
  if (stat(file.c_str(), &about) != 0) fail(whyNotOpened(errno));
  if (const auto why = refusal(about); !why.empty() && !mayBeTerminal(file, about)) fail(why);
  // Without O_NONBLOCK, opening a FIFO waits for its writer, and handled signals do not interrupt the wait.
  descriptor_ = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) fail(whyNotOpened(errno));
  // The name may refer to another file by now.
  if (fstat(descriptor_, &about) != 0 || (!refusal(about).empty() && isatty(descriptor_) != 1)) {
    close(descriptor_);
    fail("is not a regular file or a pipe; name one");
  }
  if (S_ISREG(about.st_mode)) size_ = static_cast<std::uint64_t>(about.st_size);
}

InputFile::~InputFile() { close(descriptor_); }

/// Waits for a writer: read() reports the end of a FIFO that has had no writer yet.
void InputFile::waitForInput() const {
  constexpr int kPollInterval_ms = 100;  // a signal may arrive just before poll()
  pollfd ready{descriptor_, POLLIN, 0};
  while (poll(&ready, 1, kPollInterval_ms) <= 0) throwIfInterrupted(name_ + ": nothing more was read");
}

std::size_t InputFile::read(void* to, std::size_t size) {
  while (!is_at_end_ && size > 0) {
    if (!size_) waitForInput();
    const ssize_t got = ::read(descriptor_, to, size);
    if (got > 0) return static_cast<std::size_t>(got);
    if (got == 0) {
      is_at_end_ = !size_;
      return 0;
    }
    if (errno != EINTR && errno != EAGAIN) throw std::system_error(errno, std::generic_category(), name_);
  }
  return 0;
}

void InputFile::seek(std::uint64_t position) {
  if (lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) {
    throw std::system_error(errno, std::generic_category(), name_);
  }
}

std::string readWholeFile(const std::filesystem::path& file, std::size_t max_bytes, const std::string& hint) {
  const auto refuse_size = [&] {
    throw ConfigError(file.string() + ": is larger than " + std::to_string(max_bytes >> 20) +
                      " MiB, the most that is read; " + hint);
  };
  InputFile in(file);
  if (in.size().value_or(0) > max_bytes) refuse_size();
  std::string text;
  text.reserve(in.size().value_or(0));
  char block[1 << 16];
  try {
    while (const std::size_t got = in.read(block, sizeof block)) {
      text.append(block, got);
      if (text.size() > max_bytes) refuse_size();
    }
  } catch (const std::system_error& error) {
    throw ConfigError(file.string() + ": cannot be read (" + error.code().message() + "); copy it elsewhere");
  }
  return text;
}

}  // namespace robosim
