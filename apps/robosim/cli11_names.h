#pragma once

/// Of CLI11, what headers name: all of it takes as long to compile as most files that include them.
namespace CLI {  // NOLINT(readability-identifier-naming): its own name
class App;
class Validator;
}  // namespace CLI
