#include "base/rereadable_file.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <unistd.h>

#include "base/input_file.h"

namespace robosim {
namespace {

/// Creates a file without a directory entry.
int openUnnamed() {
  std::string name = (std::filesystem::temp_directory_path() / "robosim-XXXXXX").string();
  const int descriptor = mkostemp(name.data(), 0);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), name);
  unlink(name.c_str());
  return descriptor;
}

void writeAll(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw std::system_error(errno, std::generic_category(), "copying a pipe to a temporary file");
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

}  // namespace

RereadableFile::RereadableFile(const std::filesystem::path& file) : path_(file) {
  if (std::filesystem::is_directory(file)) return;
  InputFile in(file);
  if (in.size()) return;
  copy_ = openUnnamed();
  try {
    char block[1 << 16];
    while (const std::size_t got = in.read(block, sizeof block)) writeAll(copy_, block, got);
  } catch (...) {
    close(copy_);
    throw;
  }
  path_ = "/proc/self/fd/" + std::to_string(copy_);
}

RereadableFile::~RereadableFile() {
  if (copy_ >= 0) close(copy_);
}

}  // namespace robosim
