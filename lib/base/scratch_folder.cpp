#include "base/scratch_folder.h"

#include <cstdlib>
#include <stdexcept>

#include <unistd.h>

namespace robosim {

ScratchFolder::ScratchFolder() : ScratchFolder(std::filesystem::temp_directory_path()) {}

ScratchFolder ScratchFolder::inMemory() {
  const char* const memory = "/dev/shm";
  return access(memory, W_OK) == 0 ? ScratchFolder(std::filesystem::path(memory)) : ScratchFolder();
}

ScratchFolder::ScratchFolder(const std::filesystem::path& parent) {
  std::string name = (parent / "robosim-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error(name + ": no such folder could be made; see TMPDIR");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace robosim
