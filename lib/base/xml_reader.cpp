#include "base/xml_reader.h"

#include <cmath>
#include <sstream>

namespace robosim {
namespace {

const XmlElement kNothing;
constexpr double kRadPerDeg = M_PI / 180;

/// The unit that a setting's name ends in, as a word behind its bounds.
std::string unitOf(const std::string& setting) {
  const std::pair<const char*, const char*> units[] = {{"_mps2", " metres per second squared"},
                                                       {"_degps2", " degrees per second squared"},
                                                       {"_mps", " metres per second"},
                                                       {"_degps", " degrees per second"},
                                                       {"_m", " metres"},
                                                       {"_deg", " degrees"},
                                                       {"_s", " seconds"},
                                                       {"_rad", " radians"}};
  for (const auto& [ending, unit] : units) {
    if (setting.ends_with(ending)) return unit;
  }
  return "";
}

std::string describe(const Bounds& bounds, const std::string& unit) {
  const bool bounded_below = bounds.min > -Bounds::kLargest;
  const bool bounded_above = bounds.max < Bounds::kLargest;
  if (!bounded_below && !bounded_above) return "must lie within ±1e9" + unit;
  if (!bounded_above) return (bounds.min_is_open ? "must be above " : "must be at least ") + toText(bounds.min) + unit;
  return std::string("must lie in ") + (bounds.min_is_open ? "(" : "[") + toText(bounds.min) + ", " +
         toText(bounds.max) + "]" + unit;
}

}  // namespace

XmlReader::XmlReader(const XmlElement& element, std::string file, ErrorList& errors)
    : element_(&element), file_(std::move(file)), errors_(&errors) {}

bool XmlReader::has(const std::string& setting) const {
  for (const auto& [name, value] : element_->attributes) {
    if (name == setting) return true;
  }
  for (const auto& child : element_->children) {
    if (child.name == setting) return true;
  }
  return false;
}

std::optional<XmlReader::Found> XmlReader::find(const std::string& setting) {
  const bool is_news = asked_.insert(setting).second;
  std::optional<Found> found;
  for (const auto& [name, value] : element_->attributes) {
    if (name != setting) continue;
    found = Found{value, element_->line.number, "<" + element_->name + " " + name + "=\"" + value + "\">"};
  }
  for (const auto& child : element_->children) {
    if (child.name != setting) continue;
    if (found) {
      if (is_news) XmlReader(child, file_, *errors_).error("is given twice in <" + element_->name + ">; keep one");
      break;
    }
    found = Found{child.text, child.line.number, "<" + setting + ">" + child.text + "</" + setting + ">"};
    // A value holds text only; anything else inside it is an unknown tag like any other.
    XmlReader inner(child, file_, *errors_);
    inner.asked_.insert("");
    if (is_news) inner.finish();
  }
  return found;
}

std::optional<double> XmlReader::checked(const Found& found, const std::string& setting, const Bounds& bounds,
                                         const std::string& mend) {
  const auto value = parseNumber(found.text);
  std::string fault;
  if (!value) {
    fault = found.text.empty() ? "a number is missing" : "is not a number";
  } else if (!std::isfinite(*value)) {
    fault = "must be a finite number";
  } else if (!bounds.contain(*value)) {
    fault = describe(bounds, unitOf(setting));
  } else {
    return value;
  }
  errors_->add(file_, found.line, found.quoted + ": " + fault + mend);
  return std::nullopt;
}

double XmlReader::number(const std::string& setting, Bounds bounds) { return length(setting, bounds, 1); }

double XmlReader::length(const std::string& setting, Bounds bounds, double unit_m) {
  const auto found = find(setting);
  if (!found) {
    error("<" + setting + "> is missing; add it");
  } else if (checked(*found, setting, bounds, "; write a number there")) {
    return toNumber(found->text, unit_m);
  }
  return (bounds.contain(1) ? 1 : bounds.max) * unit_m;
}

double XmlReader::number(const std::string& setting, Bounds bounds, double otherwise) {
  return length(setting, bounds, 1, otherwise);
}

double XmlReader::length(const std::string& setting, Bounds bounds, double unit_m, double otherwise_m) {
  const auto found = find(setting);
  if (!found) return otherwise_m;
  const std::string mend = "; drop it for the default, " + toText(otherwise_m, unit_m);
  return checked(*found, setting, bounds, mend) ? toNumber(found->text, unit_m) : otherwise_m;
}

double XmlReader::angle(const std::string& setting, Bounds bounds_deg, double otherwise_rad) {
  const auto found = find(setting);
  if (!found) return otherwise_rad;
  const auto value_deg =
      checked(*found, setting, bounds_deg, "; drop it for the default, " + toText(otherwise_rad / kRadPerDeg));
  return value_deg ? *value_deg * kRadPerDeg : otherwise_rad;
}

std::string XmlReader::word(const std::string& setting) {
  const auto found = find(setting);
  if (!found) {
    error("<" + setting + "> is missing; add it");
  } else if (found->text.empty()) {
    errors_->add(file_, found->line, found->quoted + ": is empty; write a word there");
  } else {
    return found->text;
  }
  return "";
}

std::string XmlReader::word(const std::string& setting, const std::string& otherwise) {
  if (has(setting)) return word(setting);
  asked_.insert(setting);
  return otherwise;
}

bool XmlReader::flag(const std::string& setting, bool otherwise) {
  return choice<bool>(setting, {{"0", false}, {"1", true}}, otherwise);
}

void XmlReader::reportChoice(const Found& found, const std::string& accepted) {
  errors_->add(file_, found.line, found.quoted + ": is unknown; accepted are: " + accepted);
}

std::vector<double> XmlReader::numbers(const std::string& setting, std::size_t count, Bounds bounds,
                                       const std::vector<double>& otherwise) {
  const auto found = find(setting);
  if (!found) return otherwise;
  std::istringstream words(found->text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = parseNumber(word);
    if (!value || !std::isfinite(*value) || !bounds.contain(*value)) {
      errors_->add(file_, found->line,
                   found->quoted + ": '" + word + "' is no number that fits; it " + describe(bounds, unitOf(setting)));
      return otherwise;
    }
    values.push_back(*value);
  }
  if (values.size() == count) return values;
  errors_->add(file_, found->line,
               found->quoted + ": has " + std::to_string(values.size()) + " numbers; write " + std::to_string(count));
  return otherwise;
}

std::optional<XmlReader> XmlReader::child(const std::string& tag) {
  auto found = all(tag);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) found[1].error("is given twice in <" + element_->name + ">; keep one");
  return found.front();
}

XmlReader XmlReader::requiredChild(const std::string& tag) {
  if (auto found = child(tag)) return *found;
  error("<" + tag + "> is missing; add it");
  // The missing element's own missing settings are no news: its reader reports to nobody.
  static thread_local ErrorList nobody;
  nobody = {};
  return {kNothing, file_, nobody};
}

std::vector<XmlReader> XmlReader::all(const std::string& tag) {
  asked_.insert(tag);
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) {
    if (child.name == tag) found.emplace_back(child, file_, *errors_);
  }
  return found;
}

std::vector<XmlReader> XmlReader::all() {
  all_asked_ = true;
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) found.emplace_back(child, file_, *errors_);
  return found;
}

void XmlReader::error(const std::string& what) {
  errors_->add(file_, element_->line.number, "<" + element_->name + ">: " + what);
}

void XmlReader::errorAt(const std::string& setting, const std::string& what) {
  if (const auto found = find(setting)) {
    errors_->add(file_, found->line, found->quoted + ": " + what);
  } else {
    error(what);
  }
}

void XmlReader::finish() {
  std::string accepted;
  for (const auto& name : asked_) {
    if (!name.empty()) accepted += (accepted.empty() ? "" : ", ") + name;
  }
  const std::string mend =
      accepted.empty() ? "; nothing but text is accepted here" : "; accepted here are: " + accepted;
  for (const auto& [name, value] : element_->attributes) {
    if (!asked_.contains(name)) error("unknown attribute " + name + "=\"" + value + "\"" + mend);
  }
  for (const auto& child : element_->children) {
    if (!all_asked_ && !asked_.contains(child.name)) {
      errors_->add(file_, child.line.number, "<" + child.name + ">: unknown tag in <" + element_->name + ">" + mend);
    }
  }
  // "" is asked for where the text is the value.
  if (!element_->text.empty() && !asked_.contains("")) {
    error("the text '" + element_->text.substr(0, 40) + "' has no meaning here; take it out");
  }
}

}  // namespace robosim
