#include "run_page/page_document.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(RunPageDocument, TakesMarksInATitleAsText) {
  const std::string html = runPageDocument("{{data}} {{style}} {{ </title><b>", {{"run", "PACKED"}});
  EXPECT_NE(html.find("<title>{{data}} {{style}} {{ &lt;/title&gt;&lt;b&gt;</title>"), std::string::npos);
  const std::string block = "<script type=\"text/plain\" id=\"run\">PACKED</script>";
  const std::size_t at = html.find(block);
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(at, html.find("</noscript>"));
  EXPECT_EQ(html.find(block, at + 1), std::string::npos);
}

}  // namespace
}  // namespace robosim
