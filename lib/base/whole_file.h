#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace robosim {

/// All that is in a file.
/// @param doubt asked of whoever gives a file that is larger than `most_bytes`: "is it a world file?"
/// @throws ConfigError when it is missing, a directory, not to be read, or larger.
std::string readWholeFile(const std::filesystem::path& file, std::size_t most_bytes, const std::string& doubt);

/// A file in the making, which stands under its name only when it is whole. Until commit() it grows as "<name>.part";
/// whatever had the name before stays as it was. Destroyed without commit(), it removes the .part.
class WholeFile {
 public:
  /// @throws ConfigError when there can be no such file.
  explicit WholeFile(const std::filesystem::path& file);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// What goes wrong, finish() tells.
  void write(std::string_view bytes);
  /// Sees to it that all is written, and tells if not; the file has no name yet.
  /// @throws std::runtime_error when there is no room for the file.
  void finish();
  /// Gives the finished file its name. Of several that belong together finish each, then commit each.
  /// @throws std::runtime_error as finish() does.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::ofstream out_;
  int error_ = 0;  ///< the first errno of writing
};

/// Tells before long work what WholeFile would tell after it, and leaves everything as it was.
/// @throws ConfigError when there can be no such file.
void checkWritable(const std::filesystem::path& file);

}  // namespace robosim
