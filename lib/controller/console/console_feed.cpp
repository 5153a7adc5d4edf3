#include "console/console_feed.h"

#include "console/page_json.h"

namespace robosim {
namespace {

/// Serialises the length of the JSON text (4 bytes, little-endian), the text, and the JPEG file.
WebMessagePtr serialize(const RobotNews& news, bool with_picture, bool with_sensors) {
  const std::string json =
      updateJson(*news.info, *news.update, with_picture ? news.picture.get() : nullptr, with_sensors);
  std::string head;
  for (int i = 0; i < 4; ++i) head += static_cast<char>(json.size() >> (8 * i) & 0xff);
  return std::make_shared<const WebMessage>(
      WebMessage::binary(head + json, with_picture ? std::string_view(news.picture->jpeg) : std::string_view()));
}

}  // namespace

WebMessagePtr UpdateMessages::of(const RobotNews& news, bool with_picture, bool with_sensors) {
  if (news.update != update_ || news.picture != picture_) {
    messages_ = {};
    update_ = news.update;
    picture_ = news.picture;
  }
  WebMessagePtr& message = messages_[(with_picture ? 1 : 0) + (with_sensors ? 2 : 0)];
  if (!message) message = serialize(news, with_picture, with_sensors);
  return message;
}

}  // namespace robosim
