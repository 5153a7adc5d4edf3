#include "net/hpack.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Fields = std::vector<HpackDecoder::Field>;

/// Bytes of a hexadecimal text with blanks.
std::string bytesOf(const std::string& hexadecimal) {
  std::string bytes, digits;
  for (const char c : hexadecimal) {
    if (c != ' ') digits += c;
  }
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

const Fields kFirst{{":method", "GET"}, {":scheme", "http"}, {":path", "/"}, {":authority", "www.example.com"}};
const Fields kSecond{{":method", "GET"},
                     {":scheme", "http"},
                     {":path", "/"},
                     {":authority", "www.example.com"},
                     {"cache-control", "no-cache"}};
const Fields kThird{{":method", "GET"},
                    {":scheme", "https"},
                    {":path", "/index.html"},
                    {":authority", "www.example.com"},
                    {"custom-key", "custom-value"}};

TEST(Hpack, DecodesTheRequestsOfRfc7541WithoutHuffmanCoding) {  // section C.3
  HpackDecoder decoder;
  EXPECT_EQ(decoder.decode(bytesOf("8286 8441 0f77 7777 2e65 7861 6d70 6c65 2e63 6f6d")), kFirst);
  EXPECT_EQ(decoder.decode(bytesOf("8286 84be 5808 6e6f 2d63 6163 6865")), kSecond);
  EXPECT_EQ(decoder.decode(bytesOf("8287 85bf 400a 6375 7374 6f6d 2d6b 6579 0c63 7573 746f 6d2d 7661 6c75 65")),
            kThird);
}

TEST(Hpack, DecodesTheRequestsOfRfc7541WithHuffmanCoding) {  // section C.4
  HpackDecoder decoder;
  EXPECT_EQ(decoder.decode(bytesOf("8286 8441 8cf1 e3c2 e5f2 3a6b a0ab 90f4 ff")), kFirst);
  EXPECT_EQ(decoder.decode(bytesOf("8286 84be 5886 a8eb 1064 9cbf")), kSecond);
  EXPECT_EQ(decoder.decode(bytesOf("8287 85bf 4088 25a8 49e9 5ba9 7d7f 8925 a849 e95b b8e8 b4bf")), kThird);
}

TEST(Hpack, DoesNotStoreLiteralsWithoutIndexing) {  // sections C.2.2 and C.2.3
  HpackDecoder decoder;
  EXPECT_EQ(decoder.decode(bytesOf("040c 2f73 616d 706c 652f 7061 7468")), (Fields{{":path", "/sample/path"}}));
  EXPECT_EQ(decoder.decode(bytesOf("1008 7061 7373 776f 7264 0673 6563 7265 74")), (Fields{{"password", "secret"}}));
  EXPECT_EQ(decoder.decode(bytesOf("be")), std::nullopt) << "the dynamic table is empty";
}

TEST(Hpack, RejectsInvalidBlocks) {
  for (const char* block : {"80", "bf", "ff ff ff ff ff 0f", "40", "40 0a 61", "44 7f", "41 8c f1", "3f e2 1f",
                            "41 84 ff ff ff ff", "41 81 fe", "04 82 00 00"}) {
    EXPECT_EQ(HpackDecoder().decode(bytesOf(block)), std::nullopt) << block;
  }
}

TEST(Hpack, BoundsTheSizeOfADecodedBlock) {
  HpackDecoder decoder;
  // An entry of 1,000 bytes, and 15 references to it of one byte each: 16 times 1,033 bytes are too many.
  const std::string stored = bytesOf("40 01 61 7f e9 06") + std::string(1000, 'x');
  EXPECT_EQ(decoder.decode(stored + std::string(14, '\xbe'))->size(), 15u);
  EXPECT_EQ(decoder.decode(stored + std::string(15, '\xbe')), std::nullopt);
}

TEST(Hpack, EvictsTheOldestEntriesFromTheDynamicTable) {
  HpackDecoder decoder;
  const std::string large = bytesOf("40 01 61 7f e1 1d") + std::string(3936, 'x');  // leaves 127 of 4,096 bytes
  const std::string small = bytesOf("40 01 62 7f 01") + std::string(128, 'y');
  ASSERT_TRUE(decoder.decode(large));
  EXPECT_EQ((*decoder.decode("\xbe"))[0].first, "a");
  ASSERT_TRUE(decoder.decode(small));
  EXPECT_EQ((*decoder.decode("\xbe"))[0].first, "b");
  EXPECT_EQ(decoder.decode("\xbf"), std::nullopt) << "the first entry is gone";
}

}  // namespace
}  // namespace robosim
