#include "recording/rawlog_file.h"

#include "base/input_file.h"

namespace robosim {

bool looksLikeRawlog(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) return true;
  char first = 0;
  if (InputFile(file).read(&first, 1) == 0) return file.extension() != ".xml";
  return first != '<' && first != '\n' && first != '\r' && first != '\t' && first != ' ' && first != '\xef';
}

}  // namespace robosim
