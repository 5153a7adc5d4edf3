#pragma once
#include "world/file_provider.h"

namespace robosim {

/// FileProvider that reads each file once and caches its text for its own lifetime, because a pipe can be read only
/// once.
FileProvider cachingFileProvider(FileProvider files);

}  // namespace robosim
