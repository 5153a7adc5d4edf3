#include "console/page_message.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

std::string errorOf(const std::string& text) {
  try {
    PageMessage::parse(text);
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(PageMessage, ReadsAHello) {
  const auto hello = PageMessage::parse(R"({"type":"hello","protocol":1,"name":"Jürgen","token":"secret"})");
  EXPECT_EQ(hello.type, PageMessage::Type::hello);
  EXPECT_EQ(hello.name, "Jürgen");
  EXPECT_EQ(hello.token, "secret");
}

TEST(PageMessage, ReadsADriveCommandAsFractionsOfTheMaximum) {
  const auto drive = PageMessage::parse(R"({"type":"drive","speed":-0.5,"pan":1})");
  EXPECT_EQ(drive.type, PageMessage::Type::drive);
  EXPECT_EQ(drive.speed, -0.5);
  EXPECT_EQ(drive.turn, std::nullopt);
  EXPECT_DOUBLE_EQ(*drive.pan_rad, M_PI_2);
  EXPECT_EQ(PageMessage::parse(R"({"type":"drive","speed":7,"turn":-7})").speed, 1);
}

TEST(PageMessage, ReadsEveryTypeByItsName) {
  for (const auto type : pageMessageTypes()) {
    const std::string protocol = type == PageMessage::Type::hello ? R"(,"protocol":1)" : "";
    EXPECT_EQ(PageMessage::parse(std::string(R"({"type":")") + nameOf(type) + "\"" + protocol + "}").type, type);
  }
}

TEST(PageMessage, TruncatesAReasonToStop) {
  const auto stop = PageMessage::parse(R"({"type":"stop","why":")" + std::string(119, 'x') + "ü\"}");
  EXPECT_EQ(stop.type, PageMessage::Type::stop);
  EXPECT_EQ(stop.why, std::string(119, 'x'));
}

TEST(PageMessage, RejectsInvalidMessages) {
  for (const char* no_object : {"", "x", "[1]", "{", "\xff\xfe", "null", R"({"type":"stop")"}) {
    EXPECT_EQ(errorOf(no_object), "a message that is not a JSON object") << no_object;
  }
  for (const char* no_type : {"{}", R"({"type":5})", R"({"type":"fly"})"}) {
    EXPECT_EQ(errorOf(no_type), "a message without a known type") << no_type;
  }
  EXPECT_EQ(errorOf(R"({"type":"stop","speed":1})"),
            "a message of the type 'stop' with 'speed', which it does not have");
  EXPECT_EQ(errorOf(R"({"type":"drive","speed":"fast"})"), "'speed' must be a finite number");
  EXPECT_EQ(errorOf(R"({"type":"drive","speed":1e999})"), "a message that is not a JSON object");
  EXPECT_EQ(errorOf(R"({"type":"drive","turn":null})"), "'turn' must be a finite number");
  EXPECT_EQ(errorOf(R"({"type":"ack","number":-1})"), "'number' must be a whole number, 0 or more");
  EXPECT_EQ(errorOf(R"({"type":"map","on":1})"), "'on' must be true or false");
  EXPECT_EQ(errorOf(R"({"type":"hello","protocol":1,"name":"a\nb"})"), "'name' with control characters");
  EXPECT_EQ(errorOf(R"({"type":"hello","protocol":1,"name":")" + std::string(61, 'x') + "\"}"),
            "'name' of 61 bytes; the most is 60");
  EXPECT_NE(errorOf(R"({"type":"hello","protocol":2})").find("protocol"), std::string::npos);
  EXPECT_NE(errorOf(R"({"type":"hello"})"), "");
}

}  // namespace
}  // namespace robosim
