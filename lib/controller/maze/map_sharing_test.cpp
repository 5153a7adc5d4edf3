#include "maze/map_sharing.h"

#include <gtest/gtest.h>

#include "hardware/robot_message.h"

namespace robosim {
namespace {

constexpr double kMapCell_m = 0.2;

SearchMap mapOf(const std::vector<Cell>& searched, const std::vector<Cell>& occupied, double cell_m = kMapCell_m) {
  SearchMap search(cell_m, 1, 0.3);
  search.map.cover({-40, -40}, {40, 40});
  for (const auto& cell : searched) search.map[cell].searched = true;
  for (const auto& cell : occupied) search.obstacles.learn(cell, Obstacles::kCertain);
  return search;
}

TEST(MapMessage, IsWrittenAsText) {
  const MapMessage message{200000, {{{-1, 2}, 0x1f, 0}, {{3, 4}, 0, 0x8000000000000000}}};
  EXPECT_EQ(message.text(), "MAP 200000 -1,2,1f,0 3,4,0,8000000000000000");
  const auto parsed = MapMessage::parse(message.text());
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->cell_um, 200000);
  EXPECT_EQ(parsed->tiles, message.tiles);
}

TEST(MapMessage, IsNotReadFromOtherTexts) {
  for (const char* text :
       {"", "MAP", "MAP ", "MAP 0 1,2,3,4", "MAP -5", "MAP 200000 1,2,3", "MAP 200000 1,2,3,4,5", "MAP 200000 1,2,g,4",
        "MAP 200000 1,2,3,4 ", "MAP 200000  1,2,3,4", "MAP 200000 1,2,3,11112222333344445", "GOLD a",
        "MAP 200000 9000000,2,3,4", "MAP 99999999999 1,2,3,4"}) {
    EXPECT_FALSE(MapMessage::parse(text)) << text;
  }
}

TEST(MapMessage, OfMaximumSizeFitsIntoAMessage) {
  MapMessage message{200000, {}};
  for (std::size_t i = 0; i < MapMessage::kMaxTiles; ++i) message.tiles.push_back({{-100, -100}, ~0ull, ~0ull});
  EXPECT_LE(message.text().size(), kMaxMessageBytes);
}

TEST(MapSharing, SendsEachCellOnce) {
  SearchMap search = mapOf({{0, 0}, {9, 0}}, {{-1, -1}});
  MapSharing sharing;
  const auto first = sharing.next(search.map);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->cell_um, 200000);
  const std::vector<MapTile> expected{{{-1, -1}, 0, 1ull << 63}, {{0, 0}, 1, 0}, {{1, 0}, 2, 0}};
  EXPECT_EQ(first->tiles, expected);
  EXPECT_FALSE(sharing.next(search.map));
  search.map[{1, 0}].searched = true;
  EXPECT_EQ(sharing.next(search.map)->tiles, (std::vector<MapTile>{{{0, 0}, 2, 0}}));
}

TEST(MapSharing, SendsALargeMapInParts) {
  SearchMap search = mapOf({}, {});
  for (int y = -40; y <= 39; ++y) {
    for (int x = -40; x <= 39; ++x) search.map[{x, y}].searched = true;
  }
  MapSharing sharing;
  std::size_t tiles = 0;
  for (int i = 0; i < 2; ++i) {
    const auto part = sharing.next(search.map);
    ASSERT_TRUE(part);
    EXPECT_LE(part->tiles.size(), MapMessage::kMaxTiles);
    tiles += part->tiles.size();
  }
  EXPECT_EQ(tiles, 100u);
  EXPECT_FALSE(sharing.next(search.map));
}

TEST(MapSharing, EntersWhatOthersSendAndDoesNotRepeatIt) {
  SearchMap sender = mapOf({{5, 6}}, {{7, 6}}), receiver = mapOf({}, {});
  MapSharing sending, receiving;
  receiving.receive(*sending.next(sender.map), receiver);
  EXPECT_TRUE((receiver.map[{5, 6}].searched));
  EXPECT_FALSE((receiver.map[{4, 6}].searched));
  EXPECT_GT((receiver.map[{7, 6}].walls_near), 0);
  EXPECT_FALSE(receiving.next(receiver.map));
}

TEST(MapSharing, ExtendsTheMapOfTheReceiver) {
  SearchMap receiver = mapOf({}, {});
  MapSharing receiving;
  receiving.receive({200000, {{{10, 0}, 1, 0}}}, receiver);  // its first cell is (80, 0)
  ASSERT_TRUE((receiver.map.contains({80, 0})));
  EXPECT_TRUE((receiver.map[{80, 0}].searched));
}

TEST(MapSharing, ConvertsCellsOfAnotherSize) {
  SearchMap receiver = mapOf({}, {});
  MapSharing receiving;
  receiving.receive({400000, {{{0, 0}, 2, 0}}}, receiver);  // x from 0.4 to 0.8 m, y from 0 to 0.4 m
  int searched = 0;
  for (std::size_t i = 0; i < receiver.map.size(); ++i) searched += receiver.map.at(i).searched ? 1 : 0;
  EXPECT_EQ(searched, 4);
  for (const Cell cell : {Cell{2, 0}, Cell{3, 0}, Cell{2, 1}, Cell{3, 1}}) EXPECT_TRUE(receiver.map[cell].searched);
  receiving.receive({50000, {{{-1, 0}, 0x80, 0}}}, receiver);  // x from -0.05 to 0, y from 0 to 0.05 m
  EXPECT_TRUE((receiver.map[{-1, 0}].searched));
}

}  // namespace
}  // namespace robosim
