#include "net/private_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error_list.h"

namespace robosim {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

/// An open file.
class OpenFile {
 public:
  /// Opens without blocking: opening a pipe would wait for its writer.
  explicit OpenFile(const std::filesystem::path& file) : descriptor_(open(file.c_str(), O_RDONLY | O_NONBLOCK)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string readFile(const std::filesystem::path& file, const std::string& what, bool is_private) {
  const auto fail = [&](const std::string& why) { throw ConfigError(file.string() + ": " + what + " " + why); };
  const OpenFile opened(file);
  if (opened.descriptor() < 0) fail(std::string("cannot be read (") + std::strerror(errno) + "); check the path");
  // Checks the open file, not its name, which may refer to another file a moment later.
  struct stat about {};
  if (fstat(opened.descriptor(), &about) != 0 || !S_ISREG(about.st_mode)) fail("is no file; name one");
  if (is_private && (about.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    fail("is open to others than its owner; restrict its permissions: chmod 600 " + file.string());
  }
  std::string text(kMaxBytes + 1, '\0');
  std::size_t size = 0;
  ssize_t got = 0;
  while (size < text.size() && (got = read(opened.descriptor(), text.data() + size, text.size() - size)) > 0) {
    size += static_cast<std::size_t>(got);
  }
  if (got < 0) fail(std::string("cannot be read (") + std::strerror(errno) + ")");
  if (size > kMaxBytes) fail("is larger than 1 MiB; is this the right file?");
  text.resize(size);
  return text;
}

}  // namespace

std::string readPrivateFile(const std::filesystem::path& file, const std::string& what) {
  return readFile(file, what, true);
}

std::string readSmallFile(const std::filesystem::path& file, const std::string& what) {
  return readFile(file, what, false);
}

}  // namespace robosim
