#pragma once
#include <list>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "base/xml_reader.h"
#include "world/file_provider.h"

namespace robosim {

/// Maximum number of files that include each other in a chain: bounds the recursion over untrusted input.
constexpr int kMaxIncludeDepth = 100;

/// The files that a world includes, directly or through other included files. Each is read once, and lies beside the
/// world file or below it. They are nested at most kMaxIncludeDepth deep.
class IncludedFiles {
 public:
  /// @param errors receives the faults; both must outlive this object
  IncludedFiles(const FileProvider& files, ErrorList& errors) : files_(files), errors_(errors) {}
  IncludedFiles(const IncludedFiles&) = delete;
  IncludedFiles& operator=(const IncludedFiles&) = delete;

  /// Reads all files that the <include> elements of the world's surface name.
  void read(XmlReader& surface) { read(surface, "", 1); }

  /// Their <surface> elements, each after the one that includes it.
  std::list<XmlReader>& surfaces() { return surfaces_; }
  /// Their names relative to the world file's folder; SourceLine::file counts them from 1.
  const std::vector<std::string>& names() const { return names_; }
  /// Folder of a file, relative to the world file's; empty, or with a final slash. @param file SourceLine::file, from 1
  const std::string& folderOf(int file) const { return folders_.at(static_cast<std::size_t>(file - 1)); }

 private:
  /// @param folder of the file that contains `surface`; not an element of folders_, which grows
  /// @param depth number of files on the way from the world to the files that `surface` includes
  void read(XmlReader& surface, const std::string& folder, int depth);

  const FileProvider& files_;
  ErrorList& errors_;
  std::list<XmlElement> roots_;  ///< readers refer to them
  std::list<XmlReader> surfaces_;
  std::vector<std::string> names_, folders_;
  std::unordered_set<std::string> once_;  ///< the names of all attempts
  std::size_t bytes_ = 0;                 ///< of all
};

}  // namespace robosim
