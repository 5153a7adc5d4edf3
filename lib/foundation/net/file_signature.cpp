#include "net/file_signature.h"

#include <sys/stat.h>

namespace robosim {

FileSignature FileSignature::of(const std::filesystem::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0) return {};
  const auto ns = [](const timespec& time) { return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec; };
  return {{static_cast<std::int64_t>(about.st_dev), static_cast<std::int64_t>(about.st_ino), about.st_size,
           ns(about.st_mtim), ns(about.st_ctim)}};
}

}  // namespace robosim
