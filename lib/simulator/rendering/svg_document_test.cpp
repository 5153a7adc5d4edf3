#include "rendering/svg_document.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(SvgDocument, RenumbersIdsInTheOrderOfTheirAppearance) {
  EXPECT_EQ(finishedSvg("<svg a='1'>\n<g id=\"surface17\"/><image id=\"image25\"/><use xlink:href=\"#image25\"/>"
                        "<use xlink:href=\"#image30\"/><g clip-path=\"url(#clip4)\"/></svg>",
                        "t", false),
            "<svg a='1'>\n<title>t</title>\n<g id=\"surface0\"/><image id=\"image0\"/><use xlink:href=\"#image0\"/>"
            "<use xlink:href=\"#image1\"/><g clip-path=\"url(#clip0)\"/></svg>");
}

TEST(SvgDocument, LeavesEmbeddedImagesUnchanged) {
  const std::string image = "<image xlink:href=\"data:image/png;base64,iVBORid=\"/>";
  EXPECT_NE(finishedSvg("<svg >\n" + image + "</svg>", "", false).find(image), std::string::npos);
}

TEST(SvgDocument, ShowsImagesWithoutInterpolationIfWanted) {
  EXPECT_EQ(finishedSvg("<svg >\n<image id=\"a\"/></svg>", "", true),
            "<svg >\n<title></title>\n<image style=\"image-rendering:optimizeSpeed;image-rendering:pixelated\" "
            "id=\"a\"/></svg>");
}

TEST(SvgDocument, HasAWellFormedTitleForAnyName) {
  const std::string svg = finishedSvg("<?xml?>\n<svg >\n</svg>", "\x01<b> & \xff", false);
  EXPECT_EQ(svg, "<?xml?>\n<svg >\n<title>?&lt;b&gt; &amp; ?</title>\n</svg>");
}

}  // namespace
}  // namespace robosim
