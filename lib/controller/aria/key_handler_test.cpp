#include "aria/key_handler.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace robosim {
namespace {

/// The keys that a source delivers in each step, separated by '|'.
std::string keysOf(KeySource& source, int steps) {
  std::string log;
  KeyHandler keys(source);
  for (const char key : {'a', 'b', ' '}) keys.addKeyHandler(key, [&log, key] { log += key; });
  keys.addKeyHandler(KeyHandler::UP, [&] { log += "UP"; });
  keys.addKeyHandler(KeyHandler::PAGEDOWN, [&] { log += "PAGEDOWN"; });
  keys.addKeyHandler(KeyHandler::ESCAPE, [&] { log += "ESCAPE"; });
  keys.addKeyHandler(KeyHandler::ENTER, [&] { log += "ENTER"; });
  for (int i = 0; i < steps; ++i) {
    keys.checkKeys();
    log += '|';
  }
  return log;
}

TEST(KeyHandler, ReceivesOneKeyOfATextPerStep) {
  TextKeys text(
      "ab.\x1b[A \x1b[6~\x1b"
      "a");
  EXPECT_EQ(keysOf(text, 9), "a|b||UP| |PAGEDOWN|ESCAPE|a||");
}

TEST(KeyHandler, IgnoresKeysWithoutAFunction) {
  TextKeys text("xa\x1b[Z\n");
  EXPECT_EQ(keysOf(text, 4), "|a|ESCAPE|ENTER|");
}

TEST(KeyHandler, HasOneFunctionPerKey) {
  TextKeys text("aaa");
  KeyHandler keys(text);
  int first = 0, second = 0;
  EXPECT_TRUE(keys.addKeyHandler('a', [&] { ++first; }));
  EXPECT_FALSE(keys.addKeyHandler('a', [&] { ++second; }));
  keys.checkKeys();
  EXPECT_TRUE(keys.remKeyHandler('a'));
  EXPECT_FALSE(keys.remKeyHandler('a'));
  keys.checkKeys();
  EXPECT_TRUE(keys.addKeyHandler('a', [&] { ++second; }));
  EXPECT_TRUE(keys.hasKeyHandler('a'));
  keys.checkKeys();
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
}

TEST(KeyHandler, LetsAFunctionRemoveItself) {
  TextKeys text("aa");
  KeyHandler keys(text);
  int calls = 0;
  keys.addKeyHandler('a', [&] {
    ++calls;
    keys.remKeyHandler('a');
  });
  keys.checkKeys();
  keys.checkKeys();
  EXPECT_EQ(calls, 1);
}

TEST(TerminalKeys, ReadsAFileAsAText) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "a.b", 3), 3);
  close(ends[1]);
  TerminalKeys pipe_keys(ends[0]);
  EXPECT_EQ(keysOf(pipe_keys, 4), "a||b||");
  close(ends[0]);
}

TEST(TerminalKeys, ReadsATerminalWithoutEchoAndRestoresIt) {
  int terminal, program;
  ASSERT_EQ(openpty(&terminal, &program, nullptr, nullptr, nullptr), 0);
  const auto mode_of = [&] {
    termios settings;
    tcgetattr(program, &settings);
    return settings.c_lflag & (ICANON | ECHO | ISIG);
  };
  const auto before = mode_of();
  {
    TerminalKeys keys(program);
    EXPECT_EQ(mode_of(), static_cast<tcflag_t>(ISIG));
    EXPECT_EQ(keysOf(keys, 1), "|");  // does not block
    ASSERT_EQ(write(terminal, "ab\x1b[A", 5), 5);
    // The kernel passes the bytes on in a thread of its own.
    pollfd arrived{.fd = program, .events = POLLIN, .revents = 0};
    for (int bytes = 0; bytes < 5;) {
      ASSERT_EQ(poll(&arrived, 1, -1), 1);
      ASSERT_EQ(ioctl(program, FIONREAD, &bytes), 0);
    }
    EXPECT_EQ(keysOf(keys, 2), "abUP||");  // all keys of a step, unlike a text
  }
  EXPECT_EQ(mode_of(), before);
  close(terminal);
  close(program);
}

}  // namespace
}  // namespace robosim
