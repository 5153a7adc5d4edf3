#include "environment/state_bytes.h"

#include <functional>

#include <gtest/gtest.h>

#include "base/digest.h"
#include "base/error_list.h"
#include "environment/testing/probe_run.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// A saved state of two robots, after a step.
struct Saved {
  World world = emptyWorld(3);
  Fleet fleet;
  std::shared_ptr<const Model> model;
  std::string bytes;

  Saved() {
    addGold(world, 1, 1);
    for (const char* name : {"a", "b"})
      addDisc(world, fleet, name, {0, 1.0 * static_cast<double>(fleet.robots.size()), 0});
    Environment environment(world, fleet, {});
    environment.send(0, "b", "delivered");
    environment.step();
    environment.send(0, "b", "pending");
    environment.broadcast(1, "to all");
    model = environment.model();
    bytes = toBytes(*model, environment.state());
  }
};

std::string errorOf(const Model& model, std::string_view bytes) {
  try {
    stateFromBytes(model, bytes);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(StateBytes, RoundTripEveryPartOfAState) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ProbeRun run(seed);
    for (std::uint32_t i = 0; i < 40; ++i) run.step();
    const Model& model = *run.environment().model();
    const State& state = run.environment().state();
    const std::string bytes = toBytes(model, state);
    const State read = stateFromBytes(model, bytes);
    EXPECT_EQ(read, state) << seed;
    EXPECT_EQ(toBytes(model, read), bytes) << seed;
  }
}

TEST(StateBytes, RoundTripAStateWithoutADigest) {
  ProbeRun run(1);
  run.step();
  const Model& model = *run.environment().model();
  State state = run.environment().state();
  state.digest.reset();
  EXPECT_EQ(stateFromBytes(model, toBytes(model, state)), state);
}

TEST(StateBytes, RefuseEveryDamagedByte) {
  Saved saved;
  ASSERT_EQ(errorOf(*saved.model, saved.bytes), "");
  for (std::size_t place = 0; place < saved.bytes.size(); ++place) {
    for (int change = 1; change < 256; ++change) {
      const char good = saved.bytes[place];
      saved.bytes[place] = static_cast<char>(good ^ change);
      ASSERT_NE(errorOf(*saved.model, saved.bytes), "") << "byte " << place << " changed by " << change;
      saved.bytes[place] = good;
    }
  }
}

TEST(StateBytes, RefuseEveryTruncationAndAnAppendedByte) {
  const Saved saved;
  for (std::size_t size = 0; size < saved.bytes.size(); ++size) {
    ASSERT_NE(errorOf(*saved.model, saved.bytes.substr(0, size)), "") << size;
  }
  EXPECT_NE(errorOf(*saved.model, saved.bytes + '\0'), "");
}

/// Replaces the checksum by the right one.
std::string sealed(std::string bytes) {
  bytes.resize(bytes.size() - 8);
  Digest digest;
  digest.addBytes(bytes.data(), bytes.size());
  const std::uint64_t checksum = digest.value();
  return bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
}

TEST(StateBytes, ErrorsStateTheFaultAndHowToFixIt) {
  const Saved saved;
  const Model& model = *saved.model;
  const std::string size = std::to_string(saved.bytes.size());
  EXPECT_EQ(errorOf(model, "<world/>"),
            "this is no saved state of RoboSim; its first bytes differ; give a state that RoboSim has saved");
  EXPECT_EQ(errorOf(model, saved.bytes.substr(0, 100)),
            "the saved state is incomplete or damaged: it has 100 bytes in place of " + size +
                "; copy it again, or save the state again");
  EXPECT_EQ(errorOf(model, ""),
            "the saved state is incomplete or damaged: it has 0 bytes in place of 44; copy it again, or save the state "
            "again");
  std::string damaged = saved.bytes;
  damaged[60] ^= 1;
  EXPECT_EQ(errorOf(model, damaged),
            "the saved state is damaged: its checksum differs; copy it again, or save the state again");
  std::string newer = saved.bytes;
  newer[16] = 12;
  EXPECT_EQ(
      errorOf(model, sealed(newer)),
      "the saved state has version 12 of the format, and this program reads version 11; use the version of RoboSim "
      "that saved it");
  Model other = model;
  other.seed = 2;
  EXPECT_EQ(errorOf(other, saved.bytes),
            "the saved state belongs to another world, other robots or sensors, or another seed or time step; load it "
            "with those of the run that saved it");
}

TEST(StateBytes, KeepABroadcastUntilItIsDelivered) {
  const Saved saved;
  Environment environment(saved.model, stateFromBytes(*saved.model, saved.bytes));
  environment.step();
  ASSERT_EQ(environment.state().readings[0].inbox.size(), 1u);
  EXPECT_EQ(environment.state().readings[0].inbox[0], (RobotMessage{"b", "a", "to all"}));
}

TEST(StateBytes, RefuseAPictureThatIsNoJpegFile) {
  ProbeRun run(1);
  std::string jpeg;
  while (jpeg.empty()) {
    run.step();
    for (const Measurement& measurement : run.environment().state().readings[0].measurements) {
      if (const auto* image = std::get_if<Image>(&measurement)) jpeg = image->jpeg;
    }
  }
  const Model& model = *run.environment().model();
  std::string forged = toBytes(model, run.environment().state());
  ASSERT_NE(forged.find(jpeg), std::string::npos);
  forged[forged.find(jpeg)] = 'G';
  EXPECT_EQ(errorOf(model, sealed(forged)),
            "the contents of a saved state are invalid: a picture is no JPEG file; save the state again");
}

TEST(StateBytes, RefuseSpeedsBeyondTheLimitsInBothDirections) {
  const Saved saved;
  const auto error_with = [&](double speed_mps, double turn_radps) {
    State state = stateFromBytes(*saved.model, saved.bytes);
    state.speed_mps[1] = speed_mps;
    state.turn_radps[1] = turn_radps;
    return errorOf(*saved.model, toBytes(*saved.model, state));
  };
  const std::string fault =
      "the contents of a saved state are invalid: a robot is faster than its limits; save the state again";
  EXPECT_EQ(error_with(1, 2), "");
  EXPECT_EQ(error_with(-1, -2), "");
  EXPECT_EQ(error_with(1.001, 0), fault);
  EXPECT_EQ(error_with(-1.001, 0), fault);
  EXPECT_EQ(error_with(0, 2.001), fault);
  EXPECT_EQ(error_with(0, -2.001), fault);
}

TEST(StateBytes, OfAnotherModelAreRefused) {
  const Saved saved;
  const auto is_refused_after = [&](const std::function<void(Model&)>& change) {
    Model other = *saved.model;
    change(other);
    return errorOf(other, saved.bytes).starts_with("the saved state belongs to another world");
  };
  const auto is_refused_in = [&](const std::function<void(World&)>& change) {
    World other = saved.model->world;
    change(other);
    return errorOf(Model(other, saved.model->fleet), saved.bytes)
        .starts_with("the saved state belongs to another world");
  };
  EXPECT_FALSE(is_refused_after([](Model&) {}));
  EXPECT_FALSE(is_refused_in([](World&) {}));
  EXPECT_TRUE(is_refused_after([](Model& m) { m.period_s = 0.2; }));
  EXPECT_TRUE(is_refused_in([](World& w) { w.bounds.x_max += 1; }));
  EXPECT_TRUE(is_refused_in([](World& w) { w.win_distance_m += 1; }));
  EXPECT_TRUE(is_refused_in([](World& w) { w.communication.range_m = 1; }));
  EXPECT_TRUE(is_refused_in([](World& w) { w.objects[0].body.heat_celsius += 1; }));
  EXPECT_TRUE(is_refused_in([](World& w) { w.objects[0].body.world_from_body.x += 1e-9; }));
  EXPECT_TRUE(is_refused_in([](World& w) { addWall(w, 2, 2, 0.1, 0.1); }));
  EXPECT_TRUE(is_refused_after([](Model& m) { m.fleet.robots[1].info.name = "c"; }));
  EXPECT_TRUE(is_refused_after([](Model& m) { m.fleet.robots[1].info.type.edit().limits.accel_mps2 *= 2; }));
  EXPECT_TRUE(is_refused_after([](Model& m) { m.fleet.robots.pop_back(); }));
  EXPECT_TRUE(is_refused_after([](Model& m) {
    auto noisier = *m.fleet.robots[1].model;
    noisier.sensors_digest += 1;
    m.fleet.robots[1].model = std::make_shared<const RobotModel>(noisier);
  }));
}

TEST(StateBytes, ForgedContentsAreRefusedOrContinueInBounds) {
  const Saved saved;
  Environment environment(saved.model, initialState(*saved.model));
  int refused = 0, read = 0;
  for (std::size_t place = 36; place < saved.bytes.size() - 8; ++place) {
    for (const unsigned char byte : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
      std::string forged = saved.bytes;
      forged[place] = static_cast<char>(byte);
      try {
        environment.restore(stateFromBytes(*saved.model, sealed(forged)));
        environment.step();
        ++read;
      } catch (const ConfigError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("the contents of a saved state are invalid: "))
            << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace robosim
