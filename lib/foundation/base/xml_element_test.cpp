#include "base/xml_element.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/random.h"
#include "base/testing/test_folder.h"
#include "base/xml_parser.h"

namespace robosim {
namespace {

std::string faultOfFile(const std::filesystem::path& file) {
  try {
    readXmlFile(file);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

class XmlFile : public TestFolder {
 protected:
  std::filesystem::path holding(const std::string& text) const {
    const auto file = folder_ / "a.xml";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
};

TEST(XmlElement, IgnoresLinesInComparisons) {
  EXPECT_EQ(parseXml("<a><b>1</b></a>", ""), parseXml("\n\n<a>\n<!-- a remark -->\n<b>\n1</b></a>\n", ""));
  EXPECT_NE(parseXml("<a><b>1</b></a>", ""), parseXml("<a><b>2</b></a>", ""));
}

TEST(XmlElement, RoundTripsThroughIndentedXml) {
  XmlElement root{.name = "a", .text = {}, .attributes = {{"x", "<\"\t\n&'>"}, {"y", "ä"}}, .children = {}, .line = {}};
  XmlElement& b = root.add("b");
  b.add("c", "1 < 2 & \"so\" on; äöü €");
  b.add("d");
  const std::string text = toXml(root);
  EXPECT_EQ(text, R"(<?xml version="1.0"?>
<a x="&lt;&quot;&#9;&#10;&amp;&apos;&gt;" y="ä">
  <b>
    <c>1 &lt; 2 &amp; "so" on; äöü €</c>
    <d/>
  </b>
</a>
)");
  EXPECT_EQ(parseXml(text, "a.xml"), root);
}

TEST_F(XmlFile, IsParsedLikeText) {
  EXPECT_EQ(readXmlFile(holding("<a><b>1</b></a>")), parseXml("<a><b>1</b></a>", ""));
  EXPECT_EQ(readXmlFile(holding("\xEF\xBB\xBF<a/>")).name, "a") << "a byte order mark";
  EXPECT_EQ(readXmlFile(holding("<a>\r\n<b/>\r\n</a>\r\n")).children[0].line.number, 2);
}

TEST_F(XmlFile, ReportsAnUnreadableFileByName) {
  const std::string missing = (folder_ / "none.xml").string();
  EXPECT_EQ(faultOfFile(missing), missing + ": no such file; check the path");
  EXPECT_EQ(faultOfFile(folder_), folder_.string() + ": is a directory; name a file in it");
  const auto empty = holding("");
  EXPECT_EQ(faultOfFile(empty), empty.string() + ":1: the file is empty; an XML document was expected");
}

TEST_F(XmlFile, RejectsALargeFileWithoutReadingAllOfIt) {
  const auto file = holding("<a>");
  std::filesystem::resize_file(file, 200'000'000);
  EXPECT_EQ(faultOfFile(file), file.string() + ": is larger than 128 MiB, the most that is read; is it a world file?");
}

TEST(ParseNumber, ReturnsInfinityOrZeroForNumbersBeyondADouble) {
  EXPECT_EQ(parseNumber("1e400"), INFINITY);
  EXPECT_EQ(parseNumber("1e-400"), 0.0);
  EXPECT_EQ(parseNumber("-0.0001e-9999"), 0.0);
  EXPECT_EQ(parseNumber("1e"), std::nullopt);
  EXPECT_EQ(toNumber("1e-9999", 0.1), 0.0);
}

TEST(ToText, RoundTripsNumbersExactly) {
  EXPECT_EQ(toText(0.1), "0.1");
  EXPECT_EQ(toText(-3), "-3");
  EXPECT_EQ(toText(0), "0");
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(rng()) << 32) | rng();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) {
      EXPECT_EQ(std::strtod(toText(value).c_str(), nullptr), value);
    }
  }
}

TEST(ToText, RoundTripsNumbersExactlyInAnyUnit) {
  EXPECT_EQ(toText(38 * 0.1, 0.1), "38");
  EXPECT_EQ(toText(0, 0.1), "0");
  Rng rng(2);
  for (const double unit : {0.1, 0.0254, 1.9, 1.0 / 3, 1000.0}) {
    for (int i = 0; i < 2000; ++i) {
      const double value = rng.uniform(-100, 100);
      EXPECT_EQ(toNumber(toText(value, unit), unit), value) << unit;
    }
  }
}

TEST(ToText, ReturnsTheShortestTextInAUnit) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const std::string written = toText(rng.below(2000) / 8.0);
    EXPECT_EQ(toText(toNumber(written, 0.1), 0.1), written);
  }
}

}  // namespace
}  // namespace robosim
