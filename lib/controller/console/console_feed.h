#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "console/map_view.h"
#include "remote/robot_news.h"
#include "web/message.h"

namespace robosim {

/// State that is sent to pages again when it has changed.
struct VersionedMessage {
  std::uint64_t version = 0;  ///< 0 as long as there is none
  WebMessagePtr message;

  /// @return whether the state differs from the previous one
  bool set(const std::string& json) {
    if (message && message->bytes() == json) return false;
    message = std::make_shared<const WebMessage>(WebMessage::text(json));
    ++version;
    return true;
  }
};

/// Cache of an update's serialised messages, one per combination of picture and sensors, shared by all pages.
class UpdateMessages {
 public:
  /// @pre `news` has an update and the robot's description, and a picture if `with_picture`
  WebMessagePtr of(const RobotNews& news, bool with_picture, bool with_sensors);

 private:
  std::shared_ptr<const RobotUpdate> update_;
  std::shared_ptr<const RobotPicture> picture_;
  std::array<WebMessagePtr, 4> messages_;
};

/// The newest state for all pages.
struct ConsoleFeed {
  VersionedMessage robot;  ///< the primary's description
  VersionedMessage team;
  VersionedMessage vitals;  ///< of the team's robots
  VersionedMessage run;     ///< the environment's
  VersionedMessage game;    ///< rounds of visitors, and results of the day
  RobotNews primary;
  UpdateMessages updates;
  VersionedMessage map;                  ///< world of the map
  std::shared_ptr<const MapView> poses;  ///< null as long as there is no map
};

}  // namespace robosim
