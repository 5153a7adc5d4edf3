#include "world/included_files.h"

#include <algorithm>
#include <filesystem>

#include "base/xml_parser.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// What is wrong with the name of an included file; empty for a valid one.
std::string includeError(const std::string& file) {
  const std::filesystem::path path(file);
  if (path.is_absolute()) return "is an absolute path; only files in the world's folder, or below it, are included";
  if (std::find(path.begin(), path.end(), "..") != path.end()) {
    return "contains '..'; only files in the world's folder, or below it, are included";
  }
  return path.extension() == kIncludedExtension ? "" : "must end in .xml";
}

void setFile(XmlElement& element, int file) {
  element.line.file = file;
  for (auto& child : element.children) setFile(child, file);
}

}  // namespace

void IncludedFiles::read(XmlReader& surface, const std::string& folder, int depth) {
  for (auto& include : surface.all("include")) {
    const std::string file = include.word("file");
    include.finish();
    if (file.empty()) continue;
    if (const std::string fault = includeError(file); !fault.empty()) {
      include.errorAt("file", fault);
      continue;
    }
    if (depth > kMaxIncludeDepth) {
      include.errorAt("file", "is nested more than " + std::to_string(kMaxIncludeDepth) +
                                  " includes deep; include it from a file nearer to the world");
      continue;
    }
    const std::string name = std::filesystem::path(folder + file).lexically_normal().string();
    if (!once_.insert(name).second) {
      include.errorAt("file", "is included already, or includes itself; include each file once");
      continue;
    }
    try {
      std::string text = files_.read(name);
      bytes_ += text.size();
      if (bytes_ > kMaxXmlFileBytes) {
        include.errorAt("file", "makes the included files larger than " + std::to_string(kMaxXmlFileBytes >> 20) +
                                    " MiB in total; make them smaller");
        return;
      }
      XmlElement& root = roots_.emplace_back(parseXml(std::move(text), files_.pathOf(name)));
      names_.push_back(name);
      std::string inner = std::filesystem::path(name).parent_path().string();
      if (!inner.empty()) inner += '/';
      folders_.push_back(inner);
      setFile(root, static_cast<int>(names_.size()));
      XmlReader part(root, files_.pathOf(name), errors_);
      if (part.name() != "surface") {
        part.error("is not a part of a world; the first element of an included file is <surface>");
        continue;
      }
      read(surfaces_.emplace_back(std::move(part)), inner, depth + 1);
    } catch (const UnreadableFile& error) {
      include.errorAt("file", error.what());
    } catch (const ConfigError& error) {
      errors_.add(error);
    }
  }
}

}  // namespace robosim
