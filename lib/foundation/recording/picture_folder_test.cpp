#include "recording/picture_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

using PictureFolderTest = TestFolder;

std::string failureOf(PictureFolder& folder) {
  try {
    folder.commit();
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "none";
}

TEST_F(PictureFolderTest, KeepsImagesThatCannotBeMovedAndReportsTheirFolder) {
  {
    PictureFolder folder(in("run.rawlog"));
    folder.write("a.jpg", "a picture");
    std::ofstream(in("run_Images")) << "a file in place of the folder";
    EXPECT_EQ(failureOf(folder), in("run_Images").string() +
                                     ": the recording's pictures could not be moved there: Not a directory; the "
                                     "recording is complete; move its pictures there from " +
                                     in("run_Images.part").string());
  }
  EXPECT_TRUE(fs::exists(in("run_Images.part/a.jpg")));
}

TEST_F(PictureFolderTest, RemovesImagesThatAKilledProgramLeft) {
  fs::create_directories(in("run_Images.part"));
  std::ofstream(in("run_Images.part/old.jpg")) << "of a killed program";
  PictureFolder folder(in("run.rawlog"));
  folder.write("a.jpg", "a picture");
  folder.commit();
  EXPECT_TRUE(fs::exists(in("run_Images/a.jpg")));
  EXPECT_FALSE(fs::exists(in("run_Images/old.jpg")));
  EXPECT_FALSE(fs::exists(in("run_Images.part")));
}

TEST_F(PictureFolderTest, ReportsDeletedImagesAsARecordingError) {
  fs::create_directories(in("run_Images"));
  PictureFolder folder(in("run.rawlog"));
  folder.write("a.jpg", "a picture");
  fs::remove_all(in("run_Images.part"));
  EXPECT_NE(failureOf(folder).find("could not be moved there: No such file or directory"), std::string::npos);
}

TEST_F(PictureFolderTest, ReportsAnInaccessibleFolderAsARecordingError) {
  fs::create_directories(in("runs"));
  PictureFolder folder(in("runs/run.rawlog"));
  folder.write("a.jpg", "a picture");
  fs::rename(in("runs"), in("elsewhere"));
  std::ofstream(in("runs")) << "a file in place of the folder";
  EXPECT_NE(failureOf(folder), "none");
}

}  // namespace
}  // namespace robosim
