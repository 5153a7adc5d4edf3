#pragma once
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "base/temporary_directory.h"

namespace robosim {

/// Test fixture with a temporary folder.
class TestFolder : public testing::Test {
 protected:
  std::filesystem::path in(const std::string& name) const { return folder_ / name; }

  std::set<std::string> filesInFolder() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }

 private:
  const TemporaryDirectory scratch_;

 protected:
  const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace robosim
