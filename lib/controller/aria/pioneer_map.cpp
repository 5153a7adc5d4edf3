#include "aria/pioneer_map.h"

#include "base/activmedia_text.h"
#include "base/input_file.h"
#include "base/printable_text.h"

namespace robosim {
namespace {

/// Maximum size of a map file [bytes].
constexpr std::size_t kMaxPioneerMapBytes = std::size_t{1} << 28;

/// Reads an object: Cairn: type x y theta "description" icon "name" [x1 y1 x2 y2]
PioneerMapObject readObject(const ActivmediaText& text) {
  const auto& words = text.words();
  if (words.size() < 8) text.fail("a cairn has a type, x, y, theta, a name, an icon and a label; something is missing");
  const auto number = [&](std::size_t i) {
    const auto value = text.parsed(words[i]);
    if (!value) text.fail("'" + quotable(words[i]) + "' of the cairn " + quotable(words[1]) + " is not a number");
    return text.checked(*value, text.number());
  };
  PioneerMapObject object{.type = words[1],
                          .pose = {number(2), number(3), Math::fixAngle(number(4))},
                          .description = words[5],
                          .icon = words[6],
                          .name = words[7],
                          .from_to = {}};
  if (words.size() >= 12) {
    object.from_to = {PioneerPose{number(8), number(9), 0}, PioneerPose{number(10), number(11), 0}};
  }
  return object;
}

}  // namespace

PioneerMap PioneerMap::readFile(const std::filesystem::path& file) {
  return parse(readWholeFile(file, kMaxPioneerMapBytes, "is it a map?"), file.string());
}

PioneerMap PioneerMap::parse(const std::string& text, const std::string& path) {
  using Section = ActivmediaText::Section;
  PioneerMap map;
  ActivmediaText records(text, path);
  while (records.next()) {
    if (records.section() == Section::lines) {
      const auto at = records.readLine();
      map.lines_.push_back({{at[0], at[1], 0}, {at[2], at[3], 0}});
    } else if (records.section() == Section::points) {
      const auto at = records.readPoint();
      map.points_.push_back({at[0], at[1], 0});
    } else if (records.words()[0] == "Cairn:") {
      map.objects_.push_back(readObject(records));
    } else if (records.words()[0] == "Resolution:" && records.words().size() > 1) {
      map.resolution_mm_ = records.parsed(records.words()[1]).value_or(0);
    }
  }
  return map;
}

const PioneerMapObject* PioneerMap::findFirstMapObject(const std::string& name, const std::string& type) const {
  for (const PioneerMapObject& object : objects_) {
    if (object.name == name && (type.empty() || object.type == type)) return &object;
  }
  return nullptr;
}

}  // namespace robosim
