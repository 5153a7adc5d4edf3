#include "base/xml_reader.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/xml_parser.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

/// Errors reported when `read` reads a text.
Lines errorsOf(const std::string& text, const std::function<void(XmlReader&)>& read) {
  ErrorList errors;
  const XmlElement root = parseXml(text, "a.xml");
  XmlReader reader(root, "a.xml", errors);
  read(reader);
  reader.finish();
  return errors.errors();
}

TEST(XmlReader, ReadsASettingFromAnAttributeOrAChild) {
  for (const char* text : {"<a x='2.5' name='gold' on='1'/>", "<a><x>2.5</x><name>gold</name><on>1</on></a>"}) {
    const Lines errors = errorsOf(text, [](XmlReader& a) {
      EXPECT_EQ(a.number("x"), 2.5);
      EXPECT_EQ(a.word("name"), "gold");
      EXPECT_TRUE(a.flag("on", false));
      EXPECT_TRUE(a.has("x"));
      EXPECT_FALSE(a.has("y"));
    });
    EXPECT_EQ(errors, Lines{}) << text;
  }
}

TEST(XmlReader, UsesDefaultsForAbsentSettings) {
  const Lines errors = errorsOf("<a/>", [](XmlReader& a) {
    EXPECT_EQ(a.number("x", Bounds::any(), 7), 7);
    EXPECT_EQ(a.word("name", "none"), "none");
    EXPECT_FALSE(a.flag("on", false));
    EXPECT_EQ(a.angle("turn_deg", Bounds::any(), 1), 1);
    EXPECT_EQ((a.choice<int>("law", {{"linear", 1}, {"inverse", 2}}, 2)), 2);
    EXPECT_EQ(a.numbers("color", 3, {0, 1}, {1, 2, 3}), (std::vector<double>{1, 2, 3}));
    EXPECT_FALSE(a.child("b"));
    EXPECT_TRUE(a.all("b").empty());
  });
  EXPECT_EQ(errors, Lines{});
}

TEST(XmlReader, DescribesTheSettingsThatAnElementMayHave) {
  const XmlElement none;
  ErrorList errors;
  XmlReader reader(none, "a.xml", errors);
  std::vector<XmlSetting> settings;
  reader.describeTo(settings);
  reader.number("range_m", Bounds::positive(100));
  reader.number("mass", {0, 5}, 2);
  reader.length("height", Bounds::notNegative(), 0.1, 1.5);
  reader.angle("turn_deg", Bounds::any(), M_PI / 2);
  reader.word("label");
  reader.word("name", "none");
  reader.flag("on", true);
  reader.choice<int>("law", {{"linear", 1}, {"inverse", 2}}, 2);
  reader.numbers("rgb", 3, {0, 1}, {1, 0.5, 0});
  if (auto noise = reader.child("noise")) noise->number("std_m", Bounds::notNegative(), 0);
  for (auto& at : reader.all("at")) at.number("x_m", Bounds::any(), 0);
  Lines lines;
  for (const auto& s : settings) lines.push_back(s.name + " | " + s.values + " | " + s.default_text);
  EXPECT_EQ(lines, (Lines{"range_m | in (0, 100] metres | ", "mass | in [0, 5] | 2", "height | at least 0 | 15",
                          "turn_deg | within ±1e9 degrees | 90", "label | a word | ", "name | a word | none",
                          "on | 0, 1 | 1", "law | linear, inverse | inverse", "rgb | 3 numbers in [0, 1] | 1 0.5 0",
                          "noise/std_m | at least 0 metres | 0", "at/x_m | within ±1e9 metres | 0"}));
}

TEST(XmlReader, AcceptsNumbersInEveryUsualForm) {
  errorsOf("<a x='+1.5' y='-2e3' z='.25' w=' 7 '/>", [](XmlReader& a) {
    EXPECT_EQ(a.number("x"), 1.5);
    EXPECT_EQ(a.number("y"), -2000);
    EXPECT_EQ(a.number("z"), 0.25);
    EXPECT_EQ(a.number("w"), 7);
  });
}

TEST(XmlReader, ReportsInvalidNumbersAndContinues) {
  const Lines errors =
      errorsOf("<a>\n<p>1,5</p>\n<q></q>\n<r>nan</r>\n<s>-inf</s>\n<t>1e999</t>\n<u>1 2</u>\n<v>+-1</v>\n</a>",
               [](XmlReader& a) {
                 for (const char* x : {"p", "q", "r", "s", "t", "u", "v", "w"}) EXPECT_EQ(a.number(x), 1);
               });
  EXPECT_EQ(errors, (Lines{"a.xml:2: <p>1,5</p>: is not a number; write a number there",
                           "a.xml:3: <q></q>: a number is missing; write a number there",
                           "a.xml:4: <r>nan</r>: must be a finite number; write a number there",
                           "a.xml:5: <s>-inf</s>: must be a finite number; write a number there",
                           "a.xml:6: <t>1e999</t>: must be a finite number; write a number there",
                           "a.xml:7: <u>1 2</u>: is not a number; write a number there",
                           "a.xml:8: <v>+-1</v>: is not a number; write a number there",
                           "a.xml:1: <a>: <w> is missing; add it"}));
}

TEST(XmlReader, ReportsNumbersOutOfBoundsWithBoundsUnitAndDefault) {
  const Lines errors =
      errorsOf("<sonar range_max_m='-1' height='0' speed_mps='3' x='2e9' loss='1.5'/>", [](XmlReader& sonar) {
        EXPECT_EQ(sonar.number("range_max_m", Bounds::positive(50), 5), 5);
        EXPECT_EQ(sonar.number("height", Bounds::positive()), 1);
        EXPECT_EQ(sonar.number("speed_mps", Bounds::notNegative(2), 0.5), 0.5);
        EXPECT_EQ(sonar.number("x"), 1);
        EXPECT_EQ(sonar.number("loss", {0, 1}, 0), 0);
      });
  EXPECT_EQ(
      errors,
      (Lines{"a.xml:1: <sonar range_max_m=\"-1\">: must lie in (0, 50] metres; drop it for the default, 5",
             "a.xml:1: <sonar height=\"0\">: must be above 0; write a number there",
             "a.xml:1: <sonar speed_mps=\"3\">: must lie in [0, 2] metres per second; drop it for the default, 0.5",
             "a.xml:1: <sonar x=\"2e9\">: must lie within ±1e9; write a number there",
             "a.xml:1: <sonar loss=\"1.5\">: must lie in [0, 1]; drop it for the default, 0"}));
}

TEST(XmlReader, ConvertsDegreesToRadiansAndReportsErrorsInDegrees) {
  const Lines errors = errorsOf("<a p_deg='180' q_deg='400'/>", [](XmlReader& a) {
    EXPECT_DOUBLE_EQ(a.angle("p_deg", {-180, 180}, 0), M_PI);
    EXPECT_DOUBLE_EQ(a.angle("q_deg", {-180, 180}, M_PI / 2), M_PI / 2);
  });
  EXPECT_EQ(errors, Lines{"a.xml:1: <a q_deg=\"400\">: must lie in [-180, 180] degrees; drop it for the default, 90"});
}

TEST(XmlReader, ConvertsLengthsToMetresAndReportsErrorsInTheFilesUnit) {
  const Lines errors = errorsOf("<a x='25' y='-1'/>", [](XmlReader& a) {
    EXPECT_EQ(a.length("x", Bounds::positive(), 0.1), 2.5);
    EXPECT_EQ(a.length("y", Bounds::positive(), 0.5), 0.5);
    EXPECT_EQ(a.length("z", Bounds::any(), 0.5), 0.5);
  });
  EXPECT_EQ(errors, (Lines{"a.xml:1: <a y=\"-1\">: must be above 0; write a number there",
                           "a.xml:1: <a>: <z> is missing; add it"}));
}

TEST(XmlReader, ReportsUnknownChoicesWithTheAcceptedOnes) {
  const Lines errors = errorsOf("<heat law='square' on='yes'/>", [](XmlReader& heat) {
    EXPECT_EQ((heat.choice<int>("law", {{"linear", 1}, {"inverse", 2}}, 1)), 1);
    EXPECT_FALSE(heat.flag("on", false));
  });
  EXPECT_EQ(errors, (Lines{"a.xml:1: <heat law=\"square\">: is unknown; accepted are: linear, inverse",
                           "a.xml:1: <heat on=\"yes\">: is unknown; accepted are: 0, 1"}));
}

TEST(XmlReader, ReadsListsOfNumbers) {
  const Lines errors = errorsOf("<a p='1 0.5  0' q='1 2' r='1 x 0' s='0 0 2'/>", [](XmlReader& a) {
    const std::vector<double> otherwise{9, 9, 9};
    EXPECT_EQ(a.numbers("p", 3, {0, 1}, otherwise), (std::vector<double>{1, 0.5, 0}));
    EXPECT_EQ(a.numbers("q", 3, {0, 5}, otherwise), otherwise);
    EXPECT_EQ(a.numbers("r", 3, {0, 1}, otherwise), otherwise);
    EXPECT_EQ(a.numbers("s", 3, {0, 1}, otherwise), otherwise);
  });
  EXPECT_EQ(errors, (Lines{"a.xml:1: <a q=\"1 2\">: has 2 numbers; write 3",
                           "a.xml:1: <a r=\"1 x 0\">: 'x' is no number that fits; it must lie in [0, 1]",
                           "a.xml:1: <a s=\"0 0 2\">: '2' is no number that fits; it must lie in [0, 1]"}));
}

TEST(XmlReader, ReportsUnreadSettingsAsUnknown) {
  const Lines errors = errorsOf("<a z='1' x='2'>\n<y>3</y>\n<why/>stray words</a>", [](XmlReader& a) {
    a.number("x");
    a.number("y");
  });
  EXPECT_EQ(errors, (Lines{"a.xml:1: <a>: unknown attribute z=\"1\"; accepted here are: x, y",
                           "a.xml:3: <why>: unknown tag in <a>; accepted here are: x, y",
                           "a.xml:1: <a>: the text 'stray words' has no meaning here; take it out"}));
}

TEST(XmlReader, ListsReadSettingsAsAccepted) {
  const Lines errors = errorsOf("<a q='1'/>", [](XmlReader& a) {
    a.word("word", "");
    a.number("number", Bounds::any(), 0);
    a.flag("flag", false);
    a.numbers("numbers", 3, Bounds::any(), {});
    a.child("child");
  });
  EXPECT_EQ(errors,
            Lines{"a.xml:1: <a>: unknown attribute q=\"1\"; accepted here are: child, flag, number, numbers, word"});
}

TEST(XmlReader, ReportsATagInsideAValue) {
  const Lines errors = errorsOf("<a>\n<x>3<y/></x></a>", [](XmlReader& a) { EXPECT_EQ(a.number("x"), 3); });
  EXPECT_EQ(errors, Lines{"a.xml:2: <y>: unknown tag in <x>; nothing but text is accepted here"});
}

TEST(XmlReader, ReportsAMissingOrEmptyWord) {
  const Lines errors = errorsOf("<a><name/><kind></kind></a>", [](XmlReader& a) {
    EXPECT_EQ(a.word("name"), "");
    EXPECT_EQ(a.word("kind", "none"), "");
    EXPECT_EQ(a.word("color"), "");
  });
  EXPECT_EQ(errors, (Lines{"a.xml:1: <name></name>: is empty; write a word there",
                           "a.xml:1: <kind></kind>: is empty; write a word there",
                           "a.xml:1: <a>: <color> is missing; add it"}));
}

TEST(XmlReader, ReportsDuplicateSettingsAndChildren) {
  const Lines errors = errorsOf("<a z='1'>\n<x>1</x>\n<x>2</x>\n<z>3</z>\n<b/>\n<b/>\n</a>", [](XmlReader& a) {
    EXPECT_EQ(a.number("x"), 1);
    EXPECT_EQ(a.number("z"), 1);
    EXPECT_EQ(a.child("b")->line().number, 5);
    EXPECT_EQ(a.number("x"), 1) << "a second read reports no error";
  });
  EXPECT_EQ(errors,
            (Lines{"a.xml:3: <x>: is given twice in <a>; keep one", "a.xml:4: <z>: is given twice in <a>; keep one",
                   "a.xml:6: <b>: is given twice in <a>; keep one"}));
}

TEST(XmlReader, ReadsAnAttributeBesideAChildOfTheSameName) {
  const Lines errors = errorsOf("<a noise='lms200'><noise x='1'/></a>", [](XmlReader& a) {
    EXPECT_EQ(a.attribute("noise", "lms200"), "lms200");
    EXPECT_TRUE(a.child("noise")->number("x", {}, 0) == 1);
  });
  EXPECT_EQ(errors, Lines{});
  EXPECT_EQ(errorsOf("<a/>", [](XmlReader& a) { EXPECT_EQ(a.attribute("noise", "lms200"), ""); }), Lines{});
}

TEST(XmlReader, ReportsAMissingChildOnce) {
  const Lines errors = errorsOf("<a/>", [](XmlReader& a) {
    XmlReader size = a.requiredChild("size");
    size.number("xmin");
    size.finish();
  });
  EXPECT_EQ(errors, Lines{"a.xml:1: <a>: <size> is missing; add it"});
}

TEST(XmlReader, VisitsChildrenInTheFilesOrder) {
  errorsOf("<a><p>1</p><q/><p>2</p></a>", [](XmlReader& a) {
    const auto p = a.all("p");
    ASSERT_EQ(p.size(), 2u);
    EXPECT_EQ(p[1].element().text, "2");
    const auto all = a.all();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[1].name(), "q");
  });
}

TEST(XmlReader, ReportsErrorsOfItsCaller) {
  const Lines errors = errorsOf("<a>\n<x>3</x></a>", [](XmlReader& a) {
    a.number("x");
    a.error("is wrong");
    a.errorAt("x", "must be even");
    a.errorAt("y", "must be there");
  });
  EXPECT_EQ(errors,
            (Lines{"a.xml:1: <a>: is wrong", "a.xml:2: <x>3</x>: must be even", "a.xml:1: <a>: must be there"}));
}

}  // namespace
}  // namespace robosim
