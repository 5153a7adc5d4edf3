#include "stage/stage_colors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "base/xml_element.h"

namespace robosim::stage {
namespace {

struct NamedColor {
  const char* name;
  std::uint32_t rgb;
};

constexpr NamedColor kColors[] = {
    {"aquamarine", 0x7fffd4},     {"azure", 0xf0ffff},       {"beige", 0xf5f5dc},        {"black", 0x000000},
    {"blue", 0x0000ff},           {"blueviolet", 0x8a2be2},  {"brown", 0xa52a2a},        {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},     {"chocolate", 0xd2691e},   {"coral", 0xff7f50},        {"cornflowerblue", 0x6495ed},
    {"cyan", 0x00ffff},           {"darkblue", 0x00008b},    {"darkcyan", 0x008b8b},     {"darkmagenta", 0x8b008b},
    {"darkgray", 0xa9a9a9},       {"darkgreen", 0x006400},   {"darkorange", 0xff8c00},   {"darkred", 0x8b0000},
    {"darkslateblue", 0x483d8b},  {"darkviolet", 0x9400d3},  {"deeppink", 0xff1493},     {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},        {"dodgerblue", 0x1e90ff},  {"firebrick", 0xb22222},    {"forestgreen", 0x228b22},
    {"gold", 0xffd700},           {"goldenrod", 0xdaa520},   {"gray", 0xbebebe},         {"green", 0x00ff00},
    {"greenyellow", 0xadff2f},    {"hotpink", 0xff69b4},     {"indianred", 0xcd5c5c},    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},          {"lavender", 0xe6e6fa},    {"lightblue", 0xadd8e6},    {"lightcyan", 0xe0ffff},
    {"lightgray", 0xd3d3d3},      {"lightgreen", 0x90ee90},  {"lightpink", 0xffb6c1},    {"lightskyblue", 0x87cefa},
    {"lightsteelblue", 0xb0c4de}, {"lightyellow", 0xffffe0}, {"limegreen", 0x32cd32},    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},        {"maroon", 0xb03060},      {"midnightblue", 0x191970}, {"navy", 0x000080},
    {"navyblue", 0x000080},       {"olivedrab", 0x6b8e23},   {"orange", 0xffa500},       {"orangered", 0xff4500},
    {"orchid", 0xda70d6},         {"palegreen", 0x98fb98},   {"peru", 0xcd853f},         {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},           {"powderblue", 0xb0e0e6},  {"purple", 0xa020f0},       {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},      {"royalblue", 0x4169e1},   {"saddlebrown", 0x8b4513},  {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},     {"seagreen", 0x2e8b57},    {"sienna", 0xa0522d},       {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},      {"slategray", 0x708090},   {"snow", 0xfffafa},         {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},      {"tan", 0xd2b48c},         {"thistle", 0xd8bfd8},      {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},      {"violet", 0xee82ee},      {"violetred", 0xd02090},    {"wheat", 0xf5deb3},
    {"white", 0xffffff},          {"yellow", 0xffff00},      {"yellowgreen", 0x9acd32}};

}  // namespace

std::optional<std::array<float, 3>> colorNamed(const std::string& given) {
  std::string name;
  for (const char c : given) {
    if (c != ' ') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (const auto grey = name.find("grey"); grey != std::string::npos) name.replace(grey, 4, "gray");
  for (const auto& color : kColors) {
    if (name != color.name) continue;
    const auto channel = [&](int shift) { return static_cast<float>(color.rgb >> shift & 0xffu) / 255; };
    return std::array{channel(16), channel(8), channel(0)};
  }
  if (name.starts_with("gray") && name.size() > 4) {
    const auto percent = parseNumber(name.substr(4));
    if (percent && *percent >= 0 && *percent <= 100) {
      const float level = static_cast<float>(std::floor(*percent * 2.55 + 0.5)) / 255;
      return std::array{level, level, level};
    }
  }
  // "red2": one of four shades of a colour, which names its brightness.
  if (name.size() > 1 && name.back() >= '1' && name.back() <= '4') {
    constexpr float kShades[] = {1, 0.932f, 0.804f, 0.545f};
    if (auto plain = colorNamed(name.substr(0, name.size() - 1))) {
      for (auto& channel : *plain) channel *= kShades[name.back() - '1'];
      return plain;
    }
  }
  return std::nullopt;
}

}  // namespace robosim::stage
