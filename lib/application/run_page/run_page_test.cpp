#include "run_page/run_page.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>
#include <zlib.h>

#include "base/random.h"

namespace robosim {
namespace {

/// The bytes of a block of a page; empty if they cannot be read.
std::string blockOf(const std::string& html, const std::string& id) {
  const std::string begin = "id=\"" + id + "\">";
  const std::size_t from = html.find(begin) + begin.size(), size = html.find('<', from) - from;
  std::vector<unsigned char> packed(size / 4 * 3);
  EVP_DecodeBlock(packed.data(), reinterpret_cast<const unsigned char*>(html.data() + from), static_cast<int>(size));
  std::string bytes(50'000'000, '\0');
  z_stream stream{};
  stream.next_in = packed.data();
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  if (inflateInit2(&stream, MAX_WBITS + 16) != Z_OK) return "";
  const int result = inflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  return result == Z_STREAM_END ? bytes : "";
}

std::string pageOf(RunPage& page) {
  return page.html([](const std::string&) {});
}

nlohmann::json headOf(const std::string& html) { return nlohmann::json::parse(blockOf(html, "run")); }

std::vector<std::int64_t> timesOf(const std::string& html) {
  std::vector<std::int64_t> times;
  std::int64_t time = 0, difference = 0;
  const std::string bytes = blockOf(html, "moments");
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint64_t number = 0;
    int shift = 0;
    do number |= static_cast<std::uint64_t>(bytes[i] & 0x7F) << std::exchange(shift, shift + 7);
    while (bytes[i++] & 0x80);
    const auto half = static_cast<std::int64_t>(number / 2);
    difference += number % 2 == 1 ? -half - 1 : half;
    times.push_back(time += difference);
  }
  return times;
}

std::string noise(Rng& rng, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += static_cast<char>('!' + static_cast<int>(rng.uniform(0, 90)));
  return text;
}

TEST(RunPage, ShortensLongMessagesAndLeavesOutTheLastThatDoNotFit) {
  RunPage page("x");
  page.addRobot({});
  Rng rng(1);
  constexpr std::size_t kMessages = 3000;
  for (std::size_t i = 0; i < kMessages; ++i) {
    page.beginMoment(0.1 * static_cast<double>(i));
    page.addEvent("message", 0, noise(rng, 4096));
  }
  const std::string html = pageOf(page);
  EXPECT_LE(html.size(), RunPage::maxBytes(1, 300));
  const auto head = headOf(html);
  const std::size_t kept = head["events"].size();
  EXPECT_GT(kept, 200u) << "they take about 10 % of 1 MB";
  EXPECT_LT(kept, 1000u);
  for (const auto& event : head["events"]) EXPECT_LE(event[3].get<std::string>().size(), 250u);
  ASSERT_EQ(head["remarks"].size(), 1u);
  EXPECT_EQ(head["remarks"][0], "The page contains the first " + std::to_string(kept) +
                                    " messages and interventions; 2," + std::to_string(kMessages - 2000 - kept) +
                                    " later ones are left out.");
}

TEST(RunPage, LeavesOutLateStatesThatDoNotFit) {
  RunPage page("x");
  constexpr std::size_t kRobots = 10, kMoments = 8'000;
  for (std::size_t robot = 0; robot < kRobots; ++robot) page.addRobot({});
  Rng rng(2);
  for (std::size_t i = 0; i < kMoments; ++i) {
    page.beginMoment(0.01 * static_cast<double>(i));
    for (std::size_t robot = 0; robot < kRobots; ++robot) {
      PageRobotState state;
      state.led_color = static_cast<std::uint32_t>(rng.uniform(0, 0x1000000));
      page.setState(robot, state);
    }
  }
  const std::string html = pageOf(page);
  EXPECT_LE(html.size(), RunPage::maxBytes(kRobots, 80));
  const auto head = headOf(html);
  ASSERT_EQ(head["remarks"].size(), 1u);
  EXPECT_EQ(head["remarks"][0].get<std::string>().find("States of the robots change too often for a page"), 0u);
  EXPECT_FALSE(blockOf(html, "states").empty());
}

TEST(RunPage, BoundsTheListsOfChangedObjects) {
  RunPage page("x");
  World world;
  world.bounds = {-5, 5, -5, 5};
  world.objects.resize(4'000);
  page.setWorld(world);
  page.addRobot({});
  for (std::size_t i = 0; i < 20; ++i) {
    page.beginMoment(static_cast<double>(i));
    world.objects[0].body.heat_celsius = static_cast<double>(i + 1);
    page.setObjects(ChangedObjects(world.objects));
  }
  const auto head = headOf(pageOf(page));
  EXPECT_EQ(head["objects"].size(), 6u) << "the first, and five with 20,000 objects";
  ASSERT_EQ(head["remarks"].size(), 1u);
  EXPECT_EQ(head["remarks"][0], "Objects change too often for a page: it contains their places until 6.000 s.");
}

TEST(RunPage, CorrectsASingleTimeThatIsFarAhead) {
  RunPage page("x");
  for (const double time_s : {0.0, 0.1, 1e9, 0.2, 0.3}) page.beginMoment(time_s);
  EXPECT_EQ(timesOf(pageOf(page)), (std::vector<std::int64_t>{0, 100'000, 200'000, 200'000, 300'000}));
}

TEST(RunPage, KeepsTheTimesBeforeSomeThatGoBack) {
  RunPage page("x");
  for (const double time_s : {0.0, 10.0, 20.0, 0.0, 0.1, 20.5, 20.2}) page.beginMoment(time_s);
  EXPECT_EQ(timesOf(pageOf(page)),
            (std::vector<std::int64_t>{0, 10'000'000, 20'000'000, 20'000'000, 20'000'000, 20'500'000, 20'500'000}));
}

TEST(RunPage, LimitsTimesToWhatJavaScriptCanHold) {
  RunPage page("x");
  for (const double time_s : {0.0, 1e300, 1e301}) page.beginMoment(time_s);
  const std::int64_t last = std::int64_t{1} << 51;
  const std::string html = pageOf(page);
  EXPECT_EQ(timesOf(html), (std::vector<std::int64_t>{0, last, last}));
  EXPECT_EQ(headOf(html)["remarks"].size(), 1u);
}

}  // namespace
}  // namespace robosim
