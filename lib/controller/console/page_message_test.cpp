#include "console/page_message.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include "console/page.h"

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
  EXPECT_EQ(hello.type, PageMessage::Type(ConsoleRequest::hello));
  EXPECT_EQ(hello.name, "Jürgen");
  EXPECT_EQ(hello.token, "secret");
}

TEST(PageMessage, ReadsADriveCommandAsFractionsOfTheMaximum) {
  const auto drive = PageMessage::parse(R"({"type":"drive","speed":-0.5,"pan":1})");
  EXPECT_EQ(drive.type, PageMessage::Type(OrderType::drive));
  EXPECT_EQ(drive.speed, -0.5);
  EXPECT_EQ(drive.turn, std::nullopt);
  EXPECT_DOUBLE_EQ(*drive.pan_rad, M_PI_2);
  EXPECT_EQ(PageMessage::parse(R"({"type":"drive","speed":7,"turn":-7})").speed, 1);
}

TEST(PageMessage, ReadsEveryTypeByItsName) {
  for (const auto& row : pageMessageRows()) {
    const std::string protocol = row.type == PageMessage::Type(ConsoleRequest::hello) ? R"(,"protocol":1)" : "";
    EXPECT_EQ(PageMessage::parse(std::string(R"({"type":")") + row.name + "\"" + protocol + "}").type, row.type);
  }
}

/// The members that each type may have, as JSON.
const std::map<std::string, std::string> kMembers{
    {"protocol", "1"}, {"name", R"("Ada")"},  {"token", R"("secret")"},  {"number", "1"},
    {"on", "true"},    {"robot", R"("Ann")"}, {"why", R"("is hidden")"}, {"speed", "0.5"},
    {"turn", "0.5"},   {"pan", "0.5"},        {"team", R"("Red")"}};

TEST(PageMessage, HasTheMembersOfItsRowAndNoOthers) {
  for (const auto& row : pageMessageRows()) {
    for (const auto& [member, value] : kMembers) {
      const bool has_member = std::any_of(row.members.begin(), row.members.end(),
                                          [&, name = member](const char* one) { return one && name == one; });
      const std::string protocol = row.type == PageMessage::Type(ConsoleRequest::hello) ? R"(,"protocol":1)" : "";
      const std::string text =
          R"({"type":")" + std::string(row.name) + "\"" + protocol + ",\"" + member + "\":" + value + "}";
      EXPECT_EQ(errorOf(text).empty(), has_member) << text;
    }
  }
}

TEST(PageMessage, ThePageListsTheOrdersThatSteer) {
  std::string list = "export const STEERING = {\n";
  for (const OrderRow& row : kOrders) {
    if (row.rule != OrderRule::steer) continue;
    const std::string change = row.speed_tenths != 0 ? mrpt::format("speed: %g", row.speed_tenths / 10.0)
                                                     : mrpt::format("turn: %g", row.turn_part);
    list += std::string("  ") + row.name + ": { " + change + " },\n";
  }
  list += "};\n";
  const auto files = pageFiles();
  const auto file =
      std::find_if(files.begin(), files.end(), [](const WebFile& one) { return one.path == "/orders.js"; });
  ASSERT_NE(file, files.end());
  const std::string text(file->bytes.begin(), file->bytes.end());
  EXPECT_NE(text.find(list), std::string::npos) << "page/orders.js must contain:\n" << list;
}

TEST(PageMessage, TruncatesAReasonToStop) {
  const auto stop = PageMessage::parse(R"({"type":"stop","why":")" + std::string(119, 'x') + "ü\"}");
  EXPECT_EQ(stop.type, PageMessage::Type(OrderType::stop));
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
