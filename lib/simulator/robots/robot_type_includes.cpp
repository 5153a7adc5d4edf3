#include "robots/robot_type_includes.h"

#include <algorithm>

#include "base/error_list.h"
#include "base/xml_parser.h"
#include "base/xml_reader.h"
#include "robots/robot_model.h"
#include "world/file_provider.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInclude = "include";
constexpr const char* kOnlyBelow = "; only files in the robot type's folder, or below it, are included";

XmlElement* findSensorsElement(XmlElement& type) {
  const auto found = std::find_if(type.children.begin(), type.children.end(),
                                  [](const auto& child) { return child.name == "sensors"; });
  return found == type.children.end() ? nullptr : &*found;
}

bool isInclude(const XmlElement& element) { return element.name == kInclude; }

/// The <include> elements of a type.
std::vector<XmlElement*> listIncludes(XmlElement& type) {
  std::vector<XmlElement*> includes;
  if (XmlElement* const sensors = findSensorsElement(type)) {
    for (auto& sensor : sensors->children) {
      if (isInclude(sensor)) includes.push_back(&sensor);
    }
  }
  return includes;
}

/// What is wrong with the name of an included file; empty for a valid one.
std::string fileNameFault(const fs::path& file) {
  if (file.is_absolute()) return std::string("is an absolute path") + kOnlyBelow;
  if (std::find(file.begin(), file.end(), "..") != file.end()) return std::string("contains '..'") + kOnlyBelow;
  return file.extension() == kIncludedExtension ? "" : "must end in .xml";
}

/// Sets an attribute of a sensor, in place of an attribute or a child of this name.
void setSetting(XmlElement& sensor, const std::string& name, const std::string& value) {
  std::erase_if(sensor.children, [&](const auto& child) { return child.name == name && child.children.empty(); });
  for (auto& [known, text] : sensor.attributes) {
    if (known != name) continue;
    text = value;
    return;
  }
  sensor.attributes.emplace_back(name, value);
}

/// Puts the sensor of the named file into an <include>.
void fill(XmlElement& include, const fs::path& type_file, ErrorList& errors) {
  XmlReader reader(include, type_file.string(), errors);
  const std::string name = reader.word("file");
  if (name.empty()) return;
  if (const std::string fault = fileNameFault(name); !fault.empty()) return reader.errorAt("file", fault);
  if (!include.children.empty() || !include.text.empty()) {
    return reader.error("has a content; an <include> has attributes only");
  }
  const FileProvider files = filesOnDisk(type_file);
  try {
    XmlElement sensor = parseXml(files.read(name), files.pathOf(name));
    if (sensor.name == "sensors" || sensor.name == "robot" || isInclude(sensor)) {
      XmlReader(sensor, files.pathOf(name), errors)
          .error("is not a sensor; the first element of an included file is one, such as <laser>");
      return;
    }
    for (const auto& [attribute, value] : include.attributes) {
      if (attribute != "file") setSetting(sensor, attribute, value);
    }
    include.attributes = {{"file", name}};
    include.children.push_back(std::move(sensor));
  } catch (const UnreadableFile& error) {
    reader.errorAt("file", error.what());
  } catch (const ConfigError& error) {
    errors.add(error);
  }
}

/// The type with each <include> replaced by its sensor.
XmlElement flattened(XmlElement type) {
  if (XmlElement* const sensors = findSensorsElement(type)) sensors->children = sensorsOf(type);
  return type;
}

}  // namespace

XmlElement withIncludedFiles(XmlElement type, const fs::path& file) {
  ErrorList errors;
  for (XmlElement* const include : listIncludes(type)) fill(*include, file, errors);
  errors.throwIfAny();
  return type;
}

XmlElement readRobotType(const RobotTypeFile& type) {
  if (!type.text) return withIncludedFiles(readXmlFile(type.file), type.file);
  XmlElement root = parseXml(*type.text, type.file.string());
  ErrorList errors;
  for (const XmlElement* const include : listIncludes(root)) {
    XmlReader(*include, type.file.string(), errors).error("is for files only; a text contains its sensors itself");
  }
  errors.throwIfAny();
  return root;
}

std::vector<XmlElement> sensorsOf(const XmlElement& type) {
  std::vector<XmlElement> all;
  for (const auto& child : type.children) {
    if (child.name != "sensors") continue;
    for (const auto& sensor : child.children) {
      if (isInclude(sensor)) {
        all.insert(all.end(), sensor.children.begin(), sensor.children.end());
      } else {
        all.push_back(sensor);
      }
    }
    break;
  }
  return all;
}

std::string resolveIncludes(const RobotTypeFile& type) {
  if (type.text) return *type.text;
  std::string text = readXmlText(type.file);
  if (text.find("<include") == std::string::npos) return text;
  XmlElement root;
  try {
    root = parseXml(text, type.file.string());
  } catch (const ConfigError&) {
    return text;  // reported, like all faults in a type's own file, by the reader of the text
  }
  if (listIncludes(root).empty()) return text;
  root = withIncludedFiles(std::move(root), type.file);
  // The lines of the included files are known only here.
  ErrorList errors;
  modelOf(root, type.file.string(), {}, errors);
  errors.throwIfAny();
  return toXml(flattened(std::move(root)));
}

std::vector<fs::path> filesIncludedBy(const RobotTypeFile& type) {
  std::vector<fs::path> files;
  try {
    // Another kind of file, such as a pipe, can be read only once.
    if (type.text || !fs::is_regular_file(type.file)) return files;
    const std::string text = readXmlText(type.file);
    if (text.find("<include") == std::string::npos) return files;
    XmlElement root = parseXml(text, type.file.string());
    for (const XmlElement* const include : listIncludes(root)) {
      for (const auto& [name, value] : include->attributes) {
        if (name == "file") files.push_back(type.file.parent_path() / value);
      }
    }
  } catch (const ConfigError&) {
    // Reported by the command that uses the type.
  }
  return files;
}

}  // namespace robosim
