#pragma once
#include <filesystem>
#include <set>
#include <string>

namespace robosim {

/// Writes the folder of a rawlog's external images, "<stem>_Images" beside it, where MRPT looks for them. Until
/// commit() it is "<stem>_Images.part"; it is created with the first image. The destructor removes the images that were
/// not committed.
class PictureFolder {
 public:
  explicit PictureFolder(const std::filesystem::path& rawlog);
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  /// Unique prefix of a camera's file names: its label, without characters that are invalid in file names.
  std::string stemFor(const std::string& label);
  /// Writes a file into the folder, and replaces an existing one of that name.
  /// @throws RecordingError when it cannot be written.
  void write(const std::string& name, const std::string& bytes);
  /// Renames the folder to its name. Call after the rawlog was committed. Files of an earlier recording are kept,
  /// except those of the same names.
  /// @throws RecordingError when that fails; the images are then left in the .part folder.
  void commit();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_, part_;
  std::set<std::string> stems_;
  bool is_made_ = false;
};

/// The folder of a rawlog's external images: "<stem>_Images" beside it.
std::filesystem::path pictureFolderOf(const std::filesystem::path& rawlog);

/// A text as part of a file name: invalid characters become _.
std::string fileNamePart(const std::string& text);

}  // namespace robosim
