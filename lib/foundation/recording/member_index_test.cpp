#include "recording/member_index.h"

#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/testing/test_folder.h"
#include "recording/gzip_file.h"
#include "recording/gzip_members.h"
#include "recording/unpacked_file.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

TEST(GzipMembers, AHeaderIsReadAsItWasWritten) {
  const auto bytes = MemberHeader{70'000, 500'000}.bytes();
  const auto read = MemberHeader::parse(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->packed, 70'000U);
  EXPECT_EQ(read->unpacked, 500'000U);
  EXPECT_FALSE(MemberHeader::parse(std::span(bytes).first(MemberHeader::kBytes - 1)));
  for (std::size_t at = 0; at < 16; ++at) {
    auto other = bytes;
    other[at] ^= 0x40;
    EXPECT_FALSE(MemberHeader::parse(other)) << at;
  }
  EXPECT_FALSE(MemberHeader::parse(MemberHeader{32, 0}.bytes())) << "a member has more than header and trailer";
}

TEST(GzipMembers, APageIsReadAsItWasWritten) {
  const std::vector<std::uint8_t> content{1, 2, 3};
  const auto bytes = IndexPage{1000, 77, content}.bytes();
  EXPECT_EQ(bytes.size(), IndexPage::kFrameBytes + 3);
  EXPECT_EQ(IndexPage::sizeOf(std::span(bytes).first(16)), bytes.size());
  EXPECT_EQ(IndexPage::positionOfLast(bytes), 1000U);
  const auto page = IndexPage::parse(bytes);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->previous, 77U);
  EXPECT_EQ(std::vector<std::uint8_t>(page->content.begin(), page->content.end()), content);
  EXPECT_FALSE(IndexPage::parse(std::span(bytes).first(bytes.size() - 1)));
  EXPECT_FALSE(MemberHeader::parse(bytes));
}

class MemberIndexTest : public TestFolder {
 protected:
  static TracePoint point(std::uint32_t step) {
    return {step, step % 3, 0.5F * static_cast<float>(step), -2, static_cast<std::uint8_t>(step % 16)};
  }

  /// Members of as many steps as their number, with some points for each step.
  void write(std::uint32_t members, std::uint32_t points_per_step = 1) {
    GzipFile file(file_);
    std::uint64_t first = 5;
    for (std::uint32_t m = 1; m <= members; ++m) {
      for (std::uint32_t step = 0; step < m; ++step) file.write(std::vector<std::uint8_t>(100, 'a'));
      MemberNote note;
      note.first_step = first;
      note.steps = m;
      note.flags = m % 8;
      for (std::uint32_t step = 0; step < m; ++step)
        note.points.insert(note.points.end(), points_per_step, point(step));
      file.endMember(std::move(note));
      first += m;
    }
    file.finish({}, {0, true, 3});
    file.commit();
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::optional<MemberIndex> indexOf(const std::string& content) const {
    std::ofstream(in("other"), std::ios::binary) << content;
    return MemberIndex::read(in("other"));
  }

  fs::path file_ = in("run.rawlog");
};

TEST_F(MemberIndexTest, HasEveryMemberWithItsPoints) {
  write(40);
  std::size_t with_points = 0;
  const auto index = MemberIndex::read(file_, [&](const MemberNote& note, std::span<const TracePoint> points) {
    ++with_points;
    ASSERT_EQ(points.size(), note.steps);
    for (std::uint32_t step = 0; step < note.steps; ++step) EXPECT_EQ(points[step], point(step));
  });
  ASSERT_TRUE(index);
  ASSERT_EQ(index->members.size(), 40U);
  EXPECT_EQ(with_points, 40U);
  std::uint64_t first = 5, unpacked = 0;
  const std::string all = bytes();
  UnpackedFile content(file_, UnpackedFile::Access::random);
  for (std::uint32_t m = 1; m <= 40; ++m) {
    const MemberNote& member = index->members[m - 1];
    EXPECT_EQ(member.first_step, first);
    EXPECT_EQ(member.steps, m);
    EXPECT_EQ(member.flags, m % 8);
    EXPECT_EQ(member.unpacked, unpacked);
    const std::string head = all.substr(member.packed, MemberHeader::kBytes);
    EXPECT_TRUE(MemberHeader::parse(std::vector<std::uint8_t>(head.begin(), head.end())));
    content.seekMember(member.packed, member.unpacked);
    std::string of_member(100 * m, '\0');
    EXPECT_EQ(content.read(of_member.data(), of_member.size()), of_member.size());
    first += m;
    unpacked += 100 * m;
  }
  EXPECT_EQ(index->summary.unpacked, unpacked);
  EXPECT_TRUE(index->summary.has_traces);
  EXPECT_EQ(index->summary.robots, 3U);
}

// 820 steps with 40 points of 16 bytes need nine pages.
TEST_F(MemberIndexTest, SpansSeveralPages) {
  write(40, 40);
  std::size_t points = 0;
  const auto index =
      MemberIndex::read(file_, [&](const MemberNote&, std::span<const TracePoint> some) { points += some.size(); });
  ASSERT_TRUE(index);
  EXPECT_EQ(points, 820U * 40);
  UnpackedFile content(file_);
  std::string all(100'000, '\0');
  EXPECT_EQ(content.read(all.data(), all.size()), 82'000U) << "pages have no content";
  EXPECT_TRUE(content.atEnd());
}

TEST_F(MemberIndexTest, IsAbsentForImpossibleStepsAndPoints) {
  MemberNote first, second;
  first.first_step = 7;
  first.steps = 2;
  first.points = {{0, 0, 1, 2, 0}, {0, 1, 3, 4, 0}, {1, 1, 5, 6, 0}};
  second.first_step = 9;
  second.steps = 1;
  second.points = {{0, 2, 1, 2, 0}};
  const auto is_read = [this](const MemberNote& a, const MemberNote& b, std::uint32_t robots) {
    GzipFile file(file_);
    file.write(std::vector<std::uint8_t>(200, 'a'));
    file.endMember(a);
    file.write(std::vector<std::uint8_t>(150, 'b'));
    file.finish(b, {0, true, robots});
    file.commit();
    return MemberIndex::read(file_).has_value();
  };
  EXPECT_TRUE(is_read(first, second, 3));
  EXPECT_FALSE(is_read(first, second, 2)) << "there is a third robot";
  EXPECT_FALSE(is_read(first, second, 4)) << "no fourth robot has a point";
  const auto is_read_with = [&](const auto& change) {
    MemberNote a = first, b = second;
    change(a, b);
    return is_read(a, b, 3);
  };
  EXPECT_FALSE(is_read_with([](auto& a, auto&) { a.steps = 3; })) << "67 bytes for each step";
  EXPECT_FALSE(is_read_with([](auto&, auto& b) { b.first_step = 8; })) << "of the first member";
  EXPECT_TRUE(is_read_with([](auto&, auto& b) { b.first_step = 20; }));
  EXPECT_FALSE(is_read_with([](auto&, auto& b) { b.points[0].step = 1; })) << "of no step of the member";
  EXPECT_FALSE(is_read_with([](auto& a, auto&) { a.points[0].step = 1; })) << "descending steps";
  EXPECT_FALSE(is_read_with([](auto& a, auto&) { a.points[1].robot = 2; })) << "no robot 1 before";
  EXPECT_FALSE(is_read_with([](auto& a, auto&) { a.points[1].x_m = std::numeric_limits<float>::infinity(); }));
  EXPECT_FALSE(is_read_with([](auto& a, auto&) { a.points[2].y_m = std::numeric_limits<float>::quiet_NaN(); }));
}

TEST_F(MemberIndexTest, IsAbsentInAFileThatIsCutAnywhere) {
  write(3);
  const std::string all = bytes();
  for (std::size_t size = 0; size < all.size(); ++size) ASSERT_FALSE(indexOf(all.substr(0, size))) << size;
  EXPECT_TRUE(indexOf(all));
  EXPECT_FALSE(indexOf(all + "x"));
  EXPECT_FALSE(indexOf(all + all)) << "it is of the second part";
  EXPECT_FALSE(indexOf(all.substr(1)));
}

TEST_F(MemberIndexTest, IsAbsentOrConsistentInADamagedFile) {
  write(4);
  const std::string all = bytes();
  for (std::size_t at = 0; at < all.size(); ++at) {
    for (const int bit : {0, 3, 7}) {
      std::string damaged = all;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      const auto index = indexOf(damaged);
      if (!index) continue;
      for (const auto& member : index->members) {
        ASSERT_LT(member.packed, all.size());
        ASSERT_LE(member.steps, 1032 * all.size());
      }
    }
  }
}

TEST_F(MemberIndexTest, IsAbsentInOtherFiles) {
  EXPECT_FALSE(indexOf(""));
  EXPECT_FALSE(indexOf(std::string(1000, '\0')));
  EXPECT_THROW(MemberIndex::read(in("none")), ConfigError);
  GzipFile(file_).commit();
  const auto empty = MemberIndex::read(file_);
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->members.empty());
}

}  // namespace
}  // namespace robosim
