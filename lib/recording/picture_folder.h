#pragma once
#include <filesystem>
#include <set>
#include <string>

namespace robosim {

/// The folder beside a rawlog where MRPT looks for pictures that lie in files of their own: "<stem>_Images". Until
/// commit() they are in "<stem>_Images.part"; there is neither before the first picture. Destroyed without commit(), it
/// removes what it has written.
class PictureFolder {
 public:
  explicit PictureFolder(const std::filesystem::path& rawlog);
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  /// What the names of one camera's files begin with: its label as far as it is fit for one, and unlike any before.
  std::string stemFor(const std::string& label);
  /// Writes a file into the folder, in place of one of that name.
  /// @throws RecordingError when it cannot be written.
  void write(const std::string& name, const std::string& bytes);
  /// Gives the folder its name. Files of an earlier recording stay in it, but for those of the same names.
  /// @throws RecordingError when that fails.
  void commit();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_, part_;
  std::set<std::string> stems_;
  bool is_made_ = false;
};

/// A text as part of a file name: what is fit for none becomes _.
std::string fileNamePart(const std::string& text);

}  // namespace robosim
