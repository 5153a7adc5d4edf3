#include "base/xml_parser.h"

#include <string>

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

/// Error text of parseXml() for a text; "none" for valid XML.
std::string errorOfXml(const std::string& text) {
  try {
    parseXml(text, "a.xml");
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

TEST(XmlParser, ReadsNamesTextsAttributesChildrenAndLines) {
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

TEST(XmlParser, RejectsInvalidXmlWithTheLine) {
  EXPECT_EQ(errorOfXml(""), "a.xml:1: the file is empty; an XML document was expected");
  EXPECT_EQ(errorOfXml(" \n\t"), "a.xml:1: the file is empty; an XML document was expected");
  EXPECT_EQ(errorOfXml("hello"), "a.xml:1: this is not XML, or the file was cut off; fix the file here or just before");
  EXPECT_EQ(errorOfXml(std::string("<a>\0</a>", 8)), "a.xml:1: this is not XML: it holds a zero byte");
  for (const auto& utf16 :
       {std::string("\xff\xfe<\0a\0", 6), std::string("\xfe\xff\0<", 4), std::string("<\0a\0", 4)}) {
    EXPECT_EQ(errorOfXml(utf16), "a.xml:1: the file is in the encoding UTF-16; save it as UTF-8");
  }
  const std::string control = "a.xml:2: the control character \\x1b is not allowed in XML; take it out";
  EXPECT_EQ(errorOfXml("<a>\n\x1b</a>"), control);
  EXPECT_EQ(errorOfXml("<a>\n<b x='\x1b'/></a>"), control);
  EXPECT_EQ(errorOfXml("<a>\n&#27;</a>"), "a.xml:2: &#27; stands for a character that XML does not allow; take it out");
  EXPECT_EQ(errorOfXml("<!-- only a remark -->"), "a.xml:1: there is no element in the file");
  EXPECT_EQ(errorOfXml("<a/>\n<b/>"), "a.xml:2: a second root element <b>; an XML file has one");
  EXPECT_EQ(errorOfXml("<a>\n<b></c>\n</a>"),
            "a.xml:2: an element is closed by another's tag, or not at all (was the file cut off?); fix the file here "
            "or just before");
  EXPECT_EQ(errorOfXml("<a>\n<b x=\"1\" x=\"2\"/></a>"),
            "a.xml:2: an attribute is given twice, or is not name=\"value\"; fix the file here or just before");
  EXPECT_EQ(errorOfXml("<a>\n<b x=1/></a>"),
            "a.xml:2: an attribute is given twice, or is not name=\"value\"; fix the file here or just before");
  EXPECT_EQ(errorOfXml("<a>\n<b>"),
            "a.xml:2: an element is closed by another's tag, or not at all (was the file cut off?); fix the file here "
            "or just before");
  EXPECT_EQ(errorOfXml("<a/>\nhello"),
            "a.xml:2: this is not XML, or the file was cut off; fix the file here or just before");
  EXPECT_EQ(errorOfXml("\n<?xml version='1.0'?><a/>"),
            "a.xml:2: <?xml …?> must be at the start of the file; remove what precedes it");
  EXPECT_EQ(errorOfXml("<a>\n<!-- b"), "a.xml:2: a comment is not closed by -->; fix the file here or just before");
}

TEST(XmlParser, RejectsAFileTruncatedAtAnyPosition) {
  const std::string document = "<?xml version=\"1.0\"?>\n<world unit=\"1\">\n  <a>1.5</a>\n  <b/>\n</world>";
  for (std::size_t length = 1; length < document.size(); ++length) {
    EXPECT_NE(errorOfXml(document.substr(0, length)), "none") << document.substr(0, length);
  }
  EXPECT_EQ(errorOfXml(document), "none");
}

TEST(XmlParser, RejectsADoctypeBeforeExpandingEntities) {
  std::string laughs = "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [\n<!ENTITY lol0 \"lol\">\n";
  for (int i = 1; i < 10; ++i) {
    const std::string inner = "&lol" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY lol" + std::to_string(i) + " \"" + repeated(inner, 10) + "\">\n";
  }
  laughs += "]>\n<world>&lol9;</world>\n";
  EXPECT_EQ(errorOfXml(laughs), "a.xml:2: a DOCTYPE (and with it entities) is not accepted; take it out");
  EXPECT_EQ(errorOfXml("<!doctype a>\n<a/>"), "a.xml:1: a <!…> declaration has no place here; take it out");
  EXPECT_EQ(errorOfXml("<a/>\n<!ELEMENT b>"), "a.xml:2: a <!…> declaration has no place here; take it out");
  EXPECT_EQ(errorOfXml("<a>\n<!ELEMENT b></a>"), "a.xml:2: a <!…> declaration has no place here; take it out");
}

TEST(XmlParser, RejectsTooDeepOrTooLargeDocuments) {
  EXPECT_EQ(errorOfXml(repeated("<a>", 98) + "text" + repeated("</a>", 98)), "none");
  const std::string too_deep = "a.xml:1: elements lie more than 98 deep; fix the file here or just before";
  EXPECT_EQ(errorOfXml(repeated("<a>", 99) + repeated("</a>", 99)), too_deep);
  EXPECT_EQ(errorOfXml(repeated("<a>", 1000000)), too_deep);
  const std::string too_large = "a.xml:2: more than 4 million elements; split the file";
  EXPECT_EQ(errorOfXml("<a>\n" + repeated("<b/>", 4000000) + "</a>"), too_large);
  EXPECT_EQ(errorOfXml("<a>\n" + repeated("<b></b>", 4000000) + "</a>"), too_large);
  EXPECT_EQ(errorOfXml("<a>\n" + repeated("<!-->-->", 4000001) + "</a>"), "none") << "comments are no elements";
  std::string attributes;
  for (int i = 0; i < 1001; ++i) attributes += " x" + std::to_string(i) + "=''";
  EXPECT_EQ(errorOfXml("<a" + attributes + "/>"),
            "a.xml:1: an element with more than 1000 attributes; is this a world file?");
}

TEST(XmlParser, ConcatenatesTheTextNodesOfAnElement) {
  EXPECT_EQ(parseXml("<a>one &lt;<!-- a remark --> t&#119;o<![CDATA[ <&> ]]>\n</a>", "").text, "one < two <&>");
  EXPECT_EQ(parseXml("<a>\n  <b/>\n  some\r\n  text <c/>\n</a>", "").text, "some\n  text");
  EXPECT_EQ(parseXml("<a x='1 &amp; 2'/>", "").attributes[0].second, "1 & 2");
}

TEST(XmlParser, DecodesTheDeclaredEncoding) {
  EXPECT_EQ(parseXml("<a>M\xC3\xBCnchen</a>", "").text, "München");
  EXPECT_EQ(parseXml("<?xml version='1.0' encoding='ISO-8859-1'?><a>M\xFCnchen</a>", "").text, "München");
  EXPECT_EQ(parseXml("<?xml version='1.0' encoding='windows-1250'?><a>Pr\xF9zkumn\xEDk</a>", "").text, "Průzkumník");
  EXPECT_EQ(
      errorOfXml("<a>\nM\xFCnchen</a>"),
      "a.xml:2: a character is not in the file's encoding, which is UTF-8 unless it names another; save it as UTF-8");
  for (const char* unknown : {"klingon", "Shift_JIS", "ISO-8859-99"}) {
    EXPECT_EQ(errorOfXml("<?xml version='1.0' encoding='" + std::string(unknown) + "'?>\n<a/>"),
              "a.xml:1: the encoding that the file names is not known, or not that of the file; save it as UTF-8")
        << unknown;
  }
}

TEST(XmlParser, ExplainsHowToWriteAnAmpersand) {
  EXPECT_EQ(errorOfXml("<a>\nthis & that</a>"), "a.xml:2: an & that is meant as such is written &amp; in XML");
  EXPECT_EQ(errorOfXml("<a>\n<b x='this & that'/></a>"), "a.xml:2: an & that is meant as such is written &amp; in XML");
  EXPECT_EQ(errorOfXml("<a>\nthis&nbsp;that</a>"), "a.xml:2: &nbsp; stands for nothing; write the character itself");
}

}  // namespace
}  // namespace robosim
