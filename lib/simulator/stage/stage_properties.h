#pragma once
#include <string>
#include <vector>

namespace robosim::stage {

/// What becomes of a property.
enum class Effect {
  translated,  ///< it has an equivalent
  display,     ///< of Stage's window, clock and threads: left out without a note
  ignored,     ///< it has no equivalent: left out with a note
};

/// Properties of a kind of entity. The table of doc/from_stage.md has the same rows.
struct PropertyRule {
  const char* where;  ///< "world", a kind of entity, or "model" for all models
  const char* names;  ///< separated by blanks; `name[n]` has an index, and a final * stands for any ending
  Effect effect;
  const char* text;  ///< its equivalent, or the reason why there is none: "… is ignored, because REASON"
};

const std::vector<PropertyRule>& propertyRules();

/// The rule of a property of an entity; null for a property that is not known.
/// @param kind Entity::kind
const PropertyRule* ruleOf(const std::string& kind, const std::string& property);

}  // namespace robosim::stage
