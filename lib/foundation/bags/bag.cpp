#include "bags/bag.h"

#include <algorithm>

#include "base/error_list.h"
#include "base/file_kind.h"

namespace robosim {
namespace {

std::unique_ptr<BagFile> openBagFile(const std::filesystem::path& file) {
  return kindOfFile(file) == FileKind::sqlite ? openSqliteBag(file) : openMcapBag(file);
}

}  // namespace

Bag::Bag(const std::filesystem::path& bag) {
  const bool is_folder = std::filesystem::is_directory(bag);
  for (const auto& file : is_folder ? bagFilesIn(bag) : std::vector{bag}) {
    files_.push_back({file, openBagFile(file), {}});
  }
}

std::optional<BagMessage> Bag::next() {
  for (; file_ < files_.size(); ++file_) {
    BagFile& bag = *files_[file_].bag;
    if (const auto message = bag.next()) return taken(file_, *message);
    if (bag.fault().empty()) continue;
    fault_ += (fault_.empty() ? "" : "; ") + (files_.size() > 1 ? files_[file_].path.filename().string() + ": " : "") +
              bag.fault();
    is_damaged_ = is_damaged_ || !bag.isCutOff();
  }
  return std::nullopt;
}

std::optional<BagMessage> Bag::at(const BagPlace& place) {
  const auto message = files_[place.file].bag->at(place);
  return message ? std::make_optional(taken(place.file, *message)) : std::nullopt;
}

/// The message, with its topic and place in all files.
BagMessage Bag::taken(std::uint32_t index, BagMessage message) {
  File& file = files_[index];
  while (file.topics.size() < file.bag->topics().size()) {
    const BagTopic& topic = file.bag->topics()[file.topics.size()];
    const auto known = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& one) {
      return one.name == topic.name && one.type == topic.type && one.encoding == topic.encoding;
    });
    file.topics.push_back(static_cast<std::size_t>(known - topics_.begin()));
    if (known == topics_.end()) topics_.push_back(topic);
  }
  message.topic = file.topics[message.topic];
  message.place.file = index;
  return message;
}

}  // namespace robosim
