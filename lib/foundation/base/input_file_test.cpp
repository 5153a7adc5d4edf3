#include "base/input_file.h"

#include <csignal>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/rereadable_file.h"
#include "base/testing/test_folder.h"

namespace robosim {
namespace {

class InputFileTest : public TestFolder {
 protected:
  static std::string refusal(const std::filesystem::path& file) {
    try {
      const InputFile in(file);
      return "";
    } catch (const ConfigError& error) {
      return error.what();
    }
  }

  std::filesystem::path makeFifo() const {
    EXPECT_EQ(mkfifo(in("fifo").c_str(), 0600), 0);
    return in("fifo");
  }
};

TEST_F(InputFileTest, RejectsOtherFileTypesByName) {
  const std::string fix = "; name a regular file or a pipe";
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is a character device" + fix);
  EXPECT_EQ(refusal(folder_), folder_.string() + ": is a directory; name a file in it");
  EXPECT_EQ(refusal(in("none")), in("none").string() + ": no such file; check the path");
  std::filesystem::create_symlink("loop", in("loop"));
  EXPECT_EQ(refusal(in("loop")), in("loop").string() + ": its symbolic links form a loop; name another file");
  std::ofstream(in("file")) << "x";
  EXPECT_EQ(refusal(in("file") / "a"),
            (in("file") / "a").string() + ": a part of the path is a file, not a directory; check the path");
}

TEST_F(InputFileTest, WaitsForTheWriterOfAPipeAndReadsToItsEnd) {
  const auto fifo = makeFifo();
  const std::string text(200'000, 'x');  // more than a pipe holds
  std::thread writer([&] { std::ofstream(fifo) << text; });
  EXPECT_EQ(readWholeFile(fifo, 1 << 20, ""), text);
  writer.join();
}

TEST_F(InputFileTest, ReadsAtMostTheMaximumSizeOfAPipe) {
  const auto fifo = makeFifo();
  const int writer = open(fifo.c_str(), O_RDWR);  // never at its end
  ASSERT_EQ(write(writer, "0123456789", 10), 10);
  InputFile in(fifo);
  char text[4];
  EXPECT_EQ(in.read(text, sizeof text), sizeof text);
  EXPECT_EQ(std::string(text, sizeof text), "0123");
  EXPECT_EQ(in.size(), std::nullopt);
  close(writer);
}

TEST_F(InputFileTest, StopsWaitingWhenInterrupted) {
  const auto fifo = makeFifo();
  const Interrupt interrupt;
  raise(SIGTERM);
  EXPECT_EQ(Interrupt::signal(), SIGTERM);
  EXPECT_THROW(readWholeFile(fifo, 1 << 20, ""), Interrupted);
}

TEST_F(InputFileTest, RereadsACopyOfAPipe) {
  const auto fifo = makeFifo();
  std::thread writer([&] { std::ofstream(fifo) << "text"; });
  const RereadableFile file(fifo);
  writer.join();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(readWholeFile(file.path(), 100, ""), "text");
  std::ofstream(in("regular")) << "x";
  EXPECT_EQ(RereadableFile(in("regular")).path(), in("regular")) << "which needs no copy";
}

TEST_F(InputFileTest, RemovesPartialFilesWhenASignalEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    const auto end_by_signal = [&] {
      removePartialFilesOnSignals();
      AtomicFile output(in("a"));
      output.write("text");
      raise(signal);
    };
    EXPECT_EXIT(end_by_signal(), testing::KilledBySignal(signal), "");
    EXPECT_FALSE(std::filesystem::exists(in("a.part")));
  }
}

}  // namespace
}  // namespace robosim
