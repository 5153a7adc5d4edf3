#include "base/type_choice.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

TEST(TypeChoice, HasATextOfItsNameAndParameters) {
  const TypeChoice choice{"flocking", {{"cohesion", "0.3"}, {"radius_m", "2"}}};
  EXPECT_EQ(choice.text(), "flocking cohesion=0.3 radius_m=2");
  EXPECT_EQ(TypeChoice::parse(choice.text()), choice);
  EXPECT_EQ(TypeChoice::parse("  flocking   cohesion=0.3\n\tradius_m=2 "), choice);
  EXPECT_EQ(TypeChoice::parse("wander"), (TypeChoice{"wander", {}}));
}

std::string errorOf(const std::string& text) {
  try {
    TypeChoice::parse(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(TypeChoice, RejectsTextsWithoutNameOrWithOtherWords) {
  EXPECT_EQ(errorOf(" "), "the name of a controller is missing");
  EXPECT_EQ(errorOf("flocking fast"), "controller 'flocking': 'fast' is no parameter; write PARAMETER=VALUE");
  EXPECT_EQ(errorOf("flocking =1"), "controller 'flocking': '=1' is no parameter; write PARAMETER=VALUE");
  EXPECT_EQ(errorOf("flocking a="), "controller 'flocking': 'a=' is no parameter; write PARAMETER=VALUE");
}

}  // namespace
}  // namespace robosim
