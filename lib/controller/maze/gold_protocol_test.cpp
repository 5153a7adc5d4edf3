#include "maze/gold_protocol.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(GoldMessage, ConsistsOfGoldAndTheNameOfTheSource) { EXPECT_EQ(GoldMessage{"Finder1"}.text(), "GOLD Finder1"); }

TEST(GoldMessage, IsParsedFromItsText) {
  for (const std::string name : {"Finder1", "a b", "GOLD ", "Ü"}) {
    EXPECT_EQ(GoldMessage::parse(GoldMessage{name}.text()), GoldMessage{name});
  }
}

TEST(GoldMessage, IsNotParsedFromOtherTexts) {
  for (const std::string text : {"", "GOLD", "GOLD ", "gold Finder1", "SILVER Finder1", " GOLD Finder1"}) {
    EXPECT_EQ(GoldMessage::parse(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace robosim
