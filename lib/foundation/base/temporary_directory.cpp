#include "base/temporary_directory.h"

#include <cstdlib>
#include <stdexcept>

#include <unistd.h>

namespace robosim {

TemporaryDirectory::TemporaryDirectory() : TemporaryDirectory(std::filesystem::temp_directory_path()) {}

TemporaryDirectory TemporaryDirectory::inMemory() {
  const char* const memory = "/dev/shm";
  return access(memory, W_OK) == 0 ? TemporaryDirectory(std::filesystem::path(memory)) : TemporaryDirectory();
}

TemporaryDirectory::TemporaryDirectory(const std::filesystem::path& parent) {
  std::string name = (parent / "robosim-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error(name + ": no such folder could be made; see TMPDIR");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace robosim
