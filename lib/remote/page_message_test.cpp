#include "remote/page_message.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

std::string complaint(const std::string& text) {
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

TEST(PageMessage, ReadsADriveCommandAsPartsOfTheMostAndWhatItLeavesOut) {
  const auto drive = PageMessage::parse(R"({"type":"drive","speed":-0.5,"pan":1})");
  EXPECT_EQ(drive.type, PageMessage::Type::drive);
  EXPECT_EQ(drive.speed, -0.5);
  EXPECT_EQ(drive.turn, std::nullopt);
  EXPECT_DOUBLE_EQ(*drive.pan_rad, M_PI_2);
  EXPECT_EQ(PageMessage::parse(R"({"type":"drive","speed":7,"turn":-7})").speed, 1);
}

TEST(PageMessage, ReadsTheWordsOf2005) {
  for (const auto& [word, type] : {std::pair{"accelerate", RemoteType::accelerate},
                                   {"decelerate", RemoteType::decelerate},
                                   {"turn_left", RemoteType::turn_left},
                                   {"turn_right", RemoteType::turn_right},
                                   {"req_heat", RemoteType::req_heat},
                                   {"req_laser", RemoteType::req_laser},
                                   {"req_sonar", RemoteType::req_sonar},
                                   {"check_win", RemoteType::check_win},
                                   {"stop", RemoteType::stop},
                                   {"alive", RemoteType::alive}}) {
    const auto message = PageMessage::parse(std::string(R"({"type":")") + word + "\"}");
    EXPECT_EQ(message.type, PageMessage::Type::steer) << word;
    EXPECT_EQ(message.order, type) << word;
  }
}

TEST(PageMessage, RefusesWhatMakesNoSense) {
  for (const char* no_object : {"", "x", "[1]", "{", "\xff\xfe", "null", R"({"type":"stop")"}) {
    EXPECT_EQ(complaint(no_object), "a message that is no JSON object") << no_object;
  }
  for (const char* no_type : {"{}", R"({"type":5})", R"({"type":"fly"})"}) {
    EXPECT_EQ(complaint(no_type), "a message without a type that is known here") << no_type;
  }
  EXPECT_EQ(complaint(R"({"type":"stop","speed":1})"),
            "a message of the type 'stop' with 'speed', which it does not have");
  EXPECT_EQ(complaint(R"({"type":"drive","speed":"fast"})"), "'speed' must be a finite number");
  EXPECT_EQ(complaint(R"({"type":"drive","speed":1e999})"), "a message that is no JSON object");
  EXPECT_EQ(complaint(R"({"type":"drive","turn":null})"), "'turn' must be a finite number");
  EXPECT_EQ(complaint(R"({"type":"ack","number":-1})"), "'number' must be a whole number, 0 or more");
  EXPECT_EQ(complaint(R"({"type":"map","on":1})"), "'on' must be true or false");
  EXPECT_EQ(complaint(R"({"type":"hello","protocol":1,"name":"a\nb"})"), "'name' with control characters");
  EXPECT_EQ(complaint(R"({"type":"hello","protocol":1,"name":")" + std::string(61, 'x') + "\"}"),
            "'name' of 61 bytes; the most is 60");
  EXPECT_NE(complaint(R"({"type":"hello","protocol":2})").find("protocol"), std::string::npos);
  EXPECT_NE(complaint(R"({"type":"hello"})"), "");
}

}  // namespace
}  // namespace robosim
