#include "base/html_table.h"

#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(HtmlTable, HasARowHeaderAndGroupsOfColumns) {
  HtmlTable table({"a & b", "1 robot", "4 robots"}, false);
  table.addGroups({{"", 1}, {"found [%]", 2}});
  table.add({"x", numberCell(1.5, 1), numberCell(std::numeric_limits<double>::infinity(), 1)});
  EXPECT_EQ(table.html(),
            "<div class=wide tabindex=0><table><thead><tr><td><th scope=colgroup class=group colspan=2>found [%]"
            "<tr><th scope=col>a &amp; b<th scope=col>1 robot<th scope=col>4 robots<tbody>\n"
            "<tr><th scope=row>x<td>1.5<td>never\n</table></div>\n");
}

TEST(HtmlTable, KeepsTheSecondColumnInView) {
  EXPECT_NE(HtmlTable({"a", "b"}, true).html().find("<table class=two>"), std::string::npos);
}

TEST(HtmlTable, HasADashForAMissingNumber) { EXPECT_EQ(numberCell(std::numeric_limits<double>::quiet_NaN(), 1), "–"); }

}  // namespace
}  // namespace robosim
