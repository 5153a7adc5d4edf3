#pragma once
#include <vector>

#include "web/server.h"

namespace robosim {

/// The files of the console's page, embedded in the program from this folder's `page/`.
std::vector<WebFile> pageFiles();

/// WebSocket subprotocol of page and console: page_message.h to the console, page_json.h to the page.
constexpr const char* kPageProtocol = "robosim.remote.1";

}  // namespace robosim
