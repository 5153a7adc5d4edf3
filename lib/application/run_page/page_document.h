#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// A file of the page, embedded in the program.
struct PageFile {
  std::string_view name;  ///< "main.js"
  std::string_view bytes;
};

/// The files of `page/`, those of the console's page that they use, and three.js, compressed.
std::vector<PageFile> runPageFiles();

/// Data of a page, in an element that scripts find by its id.
struct PageBlock {
  std::string id;
  std::string text;  ///< packedForPage()
};

/// The page that shows a run, in one HTML file: style, program and `blocks`.
/// @param title as text
std::string runPageDocument(const std::string& title, const std::vector<PageBlock>& blocks);

/// A file of the page as a server sends it.
struct ServedPageFile {
  std::string path;  ///< "/" for the page itself
  std::string type;  ///< "text/css; charset=utf-8"
  std::string bytes;
};

/// The same page without data, which comes from a server (live_source.js). Style and program are files of their own, so
/// that the server can forbid those within a page (Content Security Policy).
std::vector<ServedPageFile> servedRunPage(const std::string& title);

}  // namespace robosim
