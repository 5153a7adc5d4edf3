#include "base/html_text.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(HtmlText, EscapesWhatHtmlWouldInterpret) {
  EXPECT_EQ(escapedHtml("a<b> & \"c\" 'ü'"), "a&lt;b&gt; &amp; &quot;c&quot; 'ü'");
}

}  // namespace
}  // namespace robosim
