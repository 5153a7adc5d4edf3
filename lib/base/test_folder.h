#pragma once
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "base/scratch_folder.h"

namespace robosim {

/// A test with a folder of its own, gone when it ends.
class TestFolder : public testing::Test {
 protected:
  std::filesystem::path in(const std::string& name) const { return folder_ / name; }

  std::set<std::string> filesInFolder() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }

 private:
  const ScratchFolder scratch_;

 protected:
  const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace robosim
