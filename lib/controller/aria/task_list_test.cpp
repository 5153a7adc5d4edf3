#include "aria/task_list.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

struct Log {
  std::string text;
  void a() { text += 'a'; }
  void b() { text += 'b'; }
  void c() { text += 'c'; }
};

TEST(TaskList, CallsTheHighestPositionFirst) {
  Log log;
  TaskList tasks;
  EXPECT_TRUE(tasks.add("low", 10, makeFunctor(log, &Log::a)));
  EXPECT_TRUE(tasks.add("high", 90, makeFunctor(log, &Log::b)));
  EXPECT_TRUE(tasks.add("high too", 90, makeFunctor(log, &Log::c)));
  tasks.run();
  EXPECT_EQ(log.text, "bca");
}

TEST(TaskList, RefusesASecondTaskOfAName) {
  Log log;
  TaskList tasks;
  EXPECT_TRUE(tasks.add("task", 1, makeFunctor(log, &Log::a)));
  EXPECT_FALSE(tasks.add("task", 2, makeFunctor(log, &Log::b)));
  EXPECT_TRUE(tasks.has("task"));
  EXPECT_TRUE(tasks.rem("task"));
  EXPECT_FALSE(tasks.rem("task"));
  tasks.run();
  EXPECT_EQ(log.text, "");
}

TEST(TaskList, LetsATaskRemoveItself) {
  Log log;
  TaskList tasks;
  tasks.add("once", 5, [&] {
    log.a();
    tasks.rem("once");
  });
  tasks.add("always", 1, makeFunctor(log, &Log::b));
  tasks.run();
  tasks.run();
  EXPECT_EQ(log.text, "abb");
}

TEST(CallbackList, CallsInOrderAndForgetsByNumber) {
  Log log;
  CallbackList callbacks;
  callbacks.add(makeFunctor(log, &Log::a));
  const int b = callbacks.add(makeFunctor(log, &Log::b));
  callbacks.add(makeFunctor(log, &Log::c), ListPos::FIRST);
  callbacks.call();
  EXPECT_EQ(log.text, "cab");
  EXPECT_TRUE(callbacks.rem(b));
  EXPECT_FALSE(callbacks.rem(b));
  callbacks.call();
  EXPECT_EQ(log.text, "cabca");
}

}  // namespace
}  // namespace robosim
