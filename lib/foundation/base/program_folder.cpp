#include "base/program_folder.h"

#include <stdexcept>

namespace robosim {

std::filesystem::path programFolder() {
  std::error_code no_proc;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", no_proc);
  if (no_proc) throw std::runtime_error("cannot find the folder of this program: /proc is not mounted; mount it");
  return program.parent_path();
}

}  // namespace robosim
