#include "base/whole_file.h"

#include <cerrno>
#include <cstring>

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// The file that would be replaced or made; follows a link, so that the link stays one.
fs::path checkedPath(const fs::path& file) {
  if (!file.has_filename()) throw ConfigError(file.string() + ": is no name for a file; give one");
  std::error_code ignored;
  const auto status = fs::status(file, ignored);
  if (!fs::exists(status)) return file;
  if (fs::is_directory(status)) throw ConfigError(file.string() + ": is a folder; name a file in it");
  if (!fs::is_regular_file(status)) {
    throw ConfigError(file.string() + ": is no ordinary file, and another would take its place; choose another name");
  }
  return fs::canonical(file);
}

}  // namespace

std::string readWholeFile(const fs::path& file, std::size_t most_bytes, const std::string& doubt) {
  std::error_code error;
  const auto status = fs::status(file, error);
  const std::string name = file.string();
  if (!fs::exists(status)) throw ConfigError(name + ": no such file; check the path");
  if (fs::is_directory(status)) throw ConfigError(name + ": is a directory; name a file in it");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ConfigError(name + ": cannot be opened for reading; check its permissions");
  std::string text;
  const std::uintmax_t size = fs::file_size(file, error);  // of what is no ordinary file, there is none
  if (!error && size <= most_bytes) text.reserve(size);
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) {
      throw ConfigError(name + ": is larger than " + std::to_string(most_bytes >> 20) +
                        " MiB, the most that is read; " + doubt);
    }
  }
  return text;
}

WholeFile::WholeFile(const fs::path& file) : file_(checkedPath(file)), part_(file_.string() + ".part") {
  errno = 0;
  out_.open(part_, std::ios::binary);
  if (!out_) {
    throw ConfigError(file.string() + ": cannot be written (" + std::strerror(errno) +
                      "); check that its folder exists and may be written to");
  }
}

WholeFile::~WholeFile() {
  if (part_.empty()) return;
  out_.close();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void WholeFile::write(std::string_view bytes) {
  errno = 0;
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out_ && error_ == 0) error_ = errno;
}

void WholeFile::finish() {
  if (!out_.is_open()) return;
  errno = 0;
  out_.close();
  if (!out_) fail(std::strerror(error_ != 0 ? error_ : errno));
}

void WholeFile::commit() {
  finish();
  std::error_code error;
  fs::rename(part_, file_, error);
  if (error) fail(error.message());
  part_.clear();
}

void WholeFile::fail(const std::string& why) const {
  throw std::runtime_error(file_.string() + ": cannot be written (" + why + "); choose another place");
}

void checkWritable(const fs::path& file) { WholeFile{file}; }

}  // namespace robosim
