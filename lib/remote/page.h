#pragma once
#include <vector>

#include "remote/web_server.h"

namespace robosim {

/// The console's page, which is in the program: everything in this folder's `page/`.
std::vector<WebFile> pageFiles();

/// What the page and the console speak, as WebSocket calls it: page_message.h one way, page_json.h the other.
constexpr const char* kPageProtocol = "robosim.remote.1";

}  // namespace robosim
