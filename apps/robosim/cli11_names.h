#pragma once

/// Forward declarations of CLI11: its header takes as long to compile as most files that include it.
namespace CLI {  // NOLINT(readability-identifier-naming): its own name
class App;
class Option;
class Validator;
}  // namespace CLI
