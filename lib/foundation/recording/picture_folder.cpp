#include "recording/picture_folder.h"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw RecordingError(path.string() + ": the recording's pictures could not be written: " + why +
                       "; free disk space, or record elsewhere");
}

}  // namespace

PictureFolder::PictureFolder(const fs::path& rawlog)
    : path_(pictureFolderOf(rawlog)), part_(path_.string() + ".part") {}

PictureFolder::~PictureFolder() {
  std::error_code ignored;
  if (is_made_) fs::remove_all(part_, ignored);
}

std::string PictureFolder::stemFor(const std::string& label) {
  const std::string part = fileNamePart(label);
  std::string stem = part;
  for (int i = 2; !stems_.insert(stem).second; ++i) stem = part + "_" + std::to_string(i);
  return stem;
}

void PictureFolder::write(const std::string& name, const std::string& bytes) {
  std::error_code error;
  if (!is_made_) {
    fs::remove_all(part_, error);  // left by a killed program
    fs::create_directory(part_, error);
    if (error) fail(part_, error.message());
    is_made_ = true;
  }
  errno = 0;
  std::ofstream file(part_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(part_ / name, std::strerror(errno));
}

void PictureFolder::commit() {
  if (!std::exchange(is_made_, false)) return;  // from here on the images are kept, even after an error
  std::error_code error;
  const auto check = [&] {
    if (!error) return;
    throw RecordingError(path_.string() + ": the recording's pictures could not be moved there: " + error.message() +
                         "; the recording is complete; move its pictures there from " + part_.string());
  };
  const bool is_new = !fs::exists(path_, error);
  check();
  if (is_new) {
    fs::rename(part_, path_, error);
    return check();
  }
  fs::directory_iterator entry(part_, error);
  check();
  for (; entry != fs::directory_iterator(); entry.increment(error)) {
    fs::rename(entry->path(), path_ / entry->path().filename(), error);
    check();
  }
  check();
  fs::remove(part_, error);
}

fs::path pictureFolderOf(const fs::path& rawlog) { return rawlog.parent_path() / (rawlog.stem().string() + "_Images"); }

std::string fileNamePart(const std::string& text) {
  std::string part = text;
  for (char& c : part) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  }
  return part;
}

}  // namespace robosim
