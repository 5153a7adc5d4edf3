#include "robosim/scratch_folder.h"

#include <cstdlib>
#include <stdexcept>

namespace robosim {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "robosim-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error(name + ": no such folder could be made; see TMPDIR");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace robosim
