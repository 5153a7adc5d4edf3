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
#include "base/test_folder.h"

namespace robosim {
namespace {

/// What parseXml() says against a text.
std::string fault(const std::string& text) {
  try {
    parseXml(text, "a.xml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

std::string faultOfFile(const std::filesystem::path& file) {
  try {
    readXmlFile(file);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

class XmlFile : public TestFolder {
 protected:
  std::filesystem::path holding(const std::string& text) const {
    const auto file = folder_ / "a.xml";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
};

TEST(XmlElement, KeepsNamesTextsAttributesChildrenAndLines) {
  const XmlElement root =
      parseXml("<?xml version=\"1.0\"?>\n<a x=\"1\" y=' two '>\n  <b> some\ntext </b>\n  <c/>\n</a>", "");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.line.number, 2);
  EXPECT_EQ(root.text, "");
  ASSERT_EQ(root.attributes.size(), 2u);
  EXPECT_EQ(root.attributes[1], std::make_pair(std::string("y"), std::string("two")));
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_EQ(root.children[0].text, "some\ntext");
  EXPECT_EQ(root.children[1].name, "c");
  EXPECT_EQ(root.children[1].line.number, 5);
}

TEST(XmlElement, IsEqualWhereverItStood) {
  EXPECT_EQ(parseXml("<a><b>1</b></a>", ""), parseXml("\n\n<a>\n<!-- a remark -->\n<b>\n1</b></a>\n", ""));
  EXPECT_NE(parseXml("<a><b>1</b></a>", ""), parseXml("<a><b>2</b></a>", ""));
}

TEST(XmlElement, IsWrittenIndentedAndReadBackEqual) {
  XmlElement root{.name = "a", .text = {}, .attributes = {{"x", "<\"&'>"}}, .children = {}, .line = {}};
  XmlElement& b = root.add("b");
  b.add("c", "1 < 2 & \"so\" on; äöü €");
  b.add("d");
  const std::string text = toXml(root);
  EXPECT_EQ(text, R"(<?xml version="1.0"?>
<a x="&lt;&quot;&amp;&apos;&gt;">
  <b>
    <c>1 &lt; 2 &amp; "so" on; äöü €</c>
    <d/>
  </b>
</a>
)");
  EXPECT_EQ(parseXml(text, "a.xml"), root);
}

TEST(XmlElement, RefusesWhatIsNotXmlAndSaysWhere) {
  EXPECT_EQ(fault(""), "a.xml:1: the file is empty; an XML document was expected");
  EXPECT_EQ(fault(" \n\t"), "a.xml:1: the file is empty; an XML document was expected");
  EXPECT_EQ(fault("hello"), "a.xml:1: this is not XML, or the file was cut off; mend the file here or just before");
  EXPECT_EQ(fault(std::string("<a>\0</a>", 8)), "a.xml:1: this is not XML: it holds a zero byte");
  EXPECT_EQ(fault("<!-- only a remark -->"), "a.xml:1: there is no element in the file");
  EXPECT_EQ(fault("<a/>\n<b/>"), "a.xml:2: a second root element <b>; an XML file has one");
  EXPECT_EQ(fault("<a>\n<b></c>\n</a>"),
            "a.xml:2: an element is closed by another's tag, or not at all (was the file cut off?); mend the file here "
            "or just before");
  EXPECT_EQ(fault("<a>\n<b x=\"1\" x=\"2\"/></a>"),
            "a.xml:2: an attribute is given twice, or is not name=\"value\"; mend the file here or just before");
  EXPECT_EQ(fault("<a>\n<!-- b"), "a.xml:2: a comment is not closed by -->; mend the file here or just before");
}

TEST(XmlElement, RefusesATruncatedFileWhereverItWasCut) {
  const std::string whole = "<?xml version=\"1.0\"?>\n<world unit=\"1\">\n  <a>1.5</a>\n  <b/>\n</world>";
  for (std::size_t length = 1; length < whole.size(); ++length) {
    EXPECT_NE(fault(whole.substr(0, length)), "none") << whole.substr(0, length);
  }
  EXPECT_EQ(fault(whole), "none");
}

TEST(XmlElement, RefusesADoctypeBeforeAnyEntityIsExpanded) {
  std::string laughs = "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [\n<!ENTITY lol0 \"lol\">\n";
  for (int i = 1; i < 10; ++i) {
    const std::string inner = "&lol" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY lol" + std::to_string(i) + " \"" + repeated(inner, 10) + "\">\n";
  }
  laughs += "]>\n<world>&lol9;</world>\n";
  EXPECT_EQ(fault(laughs), "a.xml:2: a DOCTYPE (and with it entities) is not accepted; take it out");
  EXPECT_EQ(fault("<!doctype a>\n<a/>"), "a.xml:1: a <!…> declaration has no place here; take it out");
  EXPECT_EQ(fault("<a>\n<!ELEMENT b></a>"), "a.xml:2: a <!…> declaration has no place here; take it out");
}

TEST(XmlElement, RefusesWhatIsTooDeepOrBloated) {
  EXPECT_EQ(fault(repeated("<a>", 98) + "text" + repeated("</a>", 98)), "none");
  const std::string too_deep = "a.xml:1: elements lie more than 98 deep; mend the file here or just before";
  EXPECT_EQ(fault(repeated("<a>", 99) + repeated("</a>", 99)), too_deep);
  EXPECT_EQ(fault(repeated("<a>", 1000000)), too_deep);
  EXPECT_EQ(fault("<a>\n" + repeated("<b/>", 8000000) + "</a>"),
            "a.xml:2: more than 4 million elements; split the file");
  std::string attributes;
  for (int i = 0; i < 1001; ++i) attributes += " x" + std::to_string(i) + "=''";
  EXPECT_EQ(fault("<a" + attributes + "/>"),
            "a.xml:1: an element with more than 1000 attributes; is this a world file?");
}

TEST_F(XmlFile, IsReadLikeText) {
  EXPECT_EQ(readXmlFile(holding("<a><b>1</b></a>")), parseXml("<a><b>1</b></a>", ""));
  EXPECT_EQ(readXmlFile(holding("\xEF\xBB\xBF<a/>")).name, "a") << "a byte order mark";
  EXPECT_EQ(readXmlFile(holding("<a>\r\n<b/>\r\n</a>\r\n")).children[0].line.number, 2);
}

TEST_F(XmlFile, ThatCannotBeReadIsRefusedWithItsName) {
  const std::string missing = (folder_ / "none.xml").string();
  EXPECT_EQ(faultOfFile(missing), missing + ": no such file; check the path");
  EXPECT_EQ(faultOfFile(folder_), folder_.string() + ": is a directory; name a file in it");
  const auto empty = holding("");
  EXPECT_EQ(faultOfFile(empty), empty.string() + ":1: the file is empty; an XML document was expected");
}

TEST_F(XmlFile, OfTwoHundredMegabytesIsRefusedAfterReadingALittleOfIt) {
  const auto file = holding("<a>");
  std::filesystem::resize_file(file, 200'000'000);
  EXPECT_EQ(faultOfFile(file), file.string() + ": is larger than 128 MiB, the most that is read; is it a world file?");
}

TEST(ToText, ReadsBackAsExactlyTheSameNumber) {
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

TEST(ToText, InAnyUnitReadsBackAsExactlyTheSameNumber) {
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

TEST(ToText, InAUnitGivesBackWhatAPersonWrote) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const std::string written = toText(rng.below(2000) / 8.0);
    EXPECT_EQ(toText(toNumber(written, 0.1), 0.1), written);
  }
}

}  // namespace
}  // namespace robosim
