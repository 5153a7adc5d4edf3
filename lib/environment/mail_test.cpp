#include "environment/mail.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace robosim {
namespace {

struct Post {
  std::vector<mrpt::math::TPose2D> poses{{0, 0, 0}, {3, 4, 0}, {100, 0, 0}};
  std::vector<Readings> readings = std::vector<Readings>(3);
  SimTime time;
  Mail mail;

  explicit Post(const Communication& communication = {}, std::uint64_t seed = 1)
      : mail({"a", "b", "c"}, communication, seed) {}
  std::size_t step() {
    ++time.step;
    return mail.deliver(time, poses, readings);
  }
  std::vector<std::string> textsOf(std::size_t robot) const {
    std::vector<std::string> texts;
    for (const auto& message : readings[robot].inbox) texts.push_back(message.text);
    return texts;
  }
};

using Texts = std::vector<std::string>;

TEST(Mail, ArrivesInTheNextStepAndStaysForThatStepOnly) {
  Post post;
  post.mail.send(0, "b", "GOLD a");
  EXPECT_EQ(post.step(), 1u);
  EXPECT_EQ(post.textsOf(1), Texts{"GOLD a"});
  EXPECT_EQ(post.readings[1].inbox[0].from, "a");
  EXPECT_TRUE(post.textsOf(0).empty());
  EXPECT_EQ(post.step(), 0u);
  EXPECT_TRUE(post.textsOf(1).empty());
}

TEST(Mail, ComesOrderedBySenderAndThenAsSent) {
  Post post;
  post.mail.send(2, "b", "c1");
  post.mail.send(0, "b", "a1");
  post.mail.send(2, "b", "c2");
  post.mail.send(0, "b", "a2");
  post.step();
  EXPECT_EQ(post.textsOf(1), (Texts{"a1", "a2", "c1", "c2"}));
}

TEST(Mail, ReachesNoFurtherThanItsRange) {
  Post post({.range_m = 5, .loss_probability = 0});
  post.mail.send(0, "b", "5 m away");
  post.mail.send(0, "c", "100 m away");
  EXPECT_EQ(post.step(), 1u);
  EXPECT_TRUE(post.textsOf(2).empty());
  post.poses[1].x = 3.001;
  post.mail.send(0, "b", "a millimetre more");
  EXPECT_EQ(post.step(), 0u);
}

TEST(Mail, LosesAsManyMessagesAsTold) {
  Post post({.range_m = {}, .loss_probability = 0.3});
  std::size_t arrived = 0;
  for (int i = 0; i < 4000; ++i) {
    post.mail.send(0, "b", "x");
    arrived += post.step();
  }
  EXPECT_NEAR(static_cast<double>(arrived), 2800, 4 * std::sqrt(4000 * 0.3 * 0.7));
}

TEST(Mail, RefusesAnUnknownReceiverAndALongText) {
  Post post;
  EXPECT_THROW(post.mail.send(0, "nobody", "x"), std::invalid_argument);
  EXPECT_THROW(post.mail.send(0, "b", std::string(kMaxMessageBytes + 1, 'x')), std::invalid_argument);
  post.mail.send(0, "b", std::string(kMaxMessageBytes, 'x'));
  EXPECT_EQ(post.step(), 1u);
}

}  // namespace
}  // namespace robosim
