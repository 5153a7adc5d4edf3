#include "control/controller_registry.h"

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

/// Drives at the speed of its parameter, in the direction of its index.
class Drives : public Controller {
 public:
  Drives(const ControllerSetup& setup, double speed_mps) : speed_mps_(setup.robot % 2 ? -speed_mps : speed_mps) {}
  void step(Robot& robot) override { robot.drive(speed_mps_, 0); }

 private:
  double speed_mps_;
};

ControllerType drives() {
  return {"drives",
          "Drives ahead.",
          {},
          {{"speed_mps", 0.2, 0, 1, "m/s", "speed"}, {"laps", 3, 1, 10, "", "number of laps"}},
          [](const ControllerSetup& setup, const ParameterValues& parameters) -> std::unique_ptr<Controller> {
            return std::make_unique<Drives>(setup, parameters["speed_mps"]);
          }};
}

std::string errorOf(const std::function<void()>& does) {
  try {
    does();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

double speedOf(const std::string& choice, std::uint32_t index = 0) {
  ControllerRegistry registry;
  registry.add(drives());
  FakeHardware hardware;
  Robot robot(hardware);
  registry.make(choice, {.seed = 1, .robot = index})->step(robot);
  return robot.command().speed_mps;
}

TEST(ControllerRegistry, GivesAControllerTheDefaultsOfItsParametersUnlessTheyAreChosen) {
  EXPECT_EQ(speedOf("drives"), 0.2);
  EXPECT_EQ(speedOf("drives speed_mps=0.05"), 0.05);
  EXPECT_EQ(speedOf("drives laps=5 speed_mps=1"), 1);
  EXPECT_EQ(speedOf("drives speed_mps=0.05", 1), -0.05);
}

TEST(ControllerRegistry, RejectsUnknownRepeatedAndInvalidParameters) {
  ControllerRegistry registry;
  registry.add(drives());
  const auto error_of = [&](const std::string& choice) {
    return errorOf([&] { registry.make(choice, {.seed = 1, .robot = 0}); });
  };
  EXPECT_EQ(error_of("drive"), "there is no controller 'drive'; take one of drives");
  EXPECT_EQ(error_of("drives sped=1"), "controller 'drives': there is no parameter 'sped'; it has: speed_mps, laps");
  EXPECT_EQ(error_of("drives laps=2 laps=2"), "controller 'drives': the parameter laps is given twice; keep one");
  EXPECT_EQ(
      error_of("drives speed_mps=2"),
      "controller 'drives': parameter speed_mps=2 is out of bounds; use 0 to 1 m/s, or drop it for the default, 0.2");
  EXPECT_EQ(error_of("drives laps=many"),
            "controller 'drives': parameter laps=many is not a number; use 1 to 10, or drop it for the default, 3");
  EXPECT_NE(error_of("drives laps=nan"), "");
}

TEST(ControllerRegistry, RejectsFaultyTypes) {
  ControllerRegistry registry;
  registry.add(drives());
  EXPECT_EQ(errorOf([&] { registry.add(drives()); }), "controller 'drives': there is one of this name already");
  const auto error_of = [&](auto change) {
    ControllerType type = drives();
    type.name = "other";
    change(type);
    return errorOf([&] { registry.add(type); });
  };
  EXPECT_EQ(error_of([](ControllerType&) {}), "");
  EXPECT_EQ(error_of([](ControllerType& type) { type.name = "a b"; }),
            "controller 'a b': a name consists of letters, digits and '_'");
  EXPECT_EQ(error_of([](ControllerType& type) { type.name = "a", type.make = nullptr; }),
            "controller 'a': its type has no function that makes it");
  EXPECT_EQ(error_of([](ControllerType& type) { type.name = "a", type.parameters[1].name = "speed_mps"; }),
            "controller 'a': 'speed_mps' cannot be the name of a parameter");
  EXPECT_EQ(error_of([](ControllerType& type) { type.name = "a", type.parameters[1].name = "name"; }),
            "controller 'a': 'name' cannot be the name of a parameter");
  EXPECT_EQ(error_of([](ControllerType& type) { type.name = "a", type.parameters[0].default_value = 2; }),
            "controller 'a': the default value of the parameter speed_mps is out of bounds");
}

TEST(ControllerRegistry, ReportsTheUseOfAnUndeclaredParameter) {
  ControllerRegistry registry;
  registry.add(drives());
  EXPECT_THROW(registry.parametersOf("drives")["gain"], std::logic_error);
}

}  // namespace
}  // namespace robosim
