#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// The known name that a misspelt one most likely stands for: that with the least edit distance (inserted, removed,
/// changed and exchanged letters), which is at most a third of the name's length; of equal ones the first. nullopt when
/// none is so near.
std::optional<std::string> nearestName(std::string_view name, const std::vector<std::string>& known);

/// "; did you mean NAME?", or an empty text.
std::string didYouMean(std::string_view name, const std::vector<std::string>& known);

}  // namespace robosim
