#include "base/xml_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/angle_units.h"
#include "base/printable_text.h"

namespace robosim {
namespace {

const XmlElement kNothing;

/// The unit in which a setting's name ends, as printed after its bounds.
std::string unitOf(const std::string& setting) {
  const std::pair<const char*, const char*> units[] = {{"_mps2", " metres per second squared"},
                                                       {"_degps2", " degrees per second squared"},
                                                       {"_mps", " metres per second"},
                                                       {"_degps", " degrees per second"},
                                                       {"_m", " metres"},
                                                       {"_deg", " degrees"},
                                                       {"_s", " seconds"},
                                                       {"_rad", " radians"},
                                                       {"_px", " pixels"},
                                                       {"_hz", " hertz"}};
  for (const auto& [ending, unit] : units) {
    if (setting.ends_with(ending)) return unit;
  }
  return "";
}

/// The bounds as a text after `must_lie` ("must lie") or, for an open interval, `must_be` ("must be").
std::string textOf(const Bounds& bounds, const std::string& unit, const std::string& must_be,
                   const std::string& must_lie) {
  const bool bounded_below = bounds.min > -Bounds::kLargest;
  const bool bounded_above = bounds.max < Bounds::kLargest;
  if (!bounded_below && !bounded_above) return must_lie + "within ±1e9" + unit;
  if (!bounded_above) return must_be + (bounds.min_is_open ? "above " : "at least ") + toText(bounds.min) + unit;
  return must_lie + "in " + (bounds.min_is_open ? "(" : "[") + toText(bounds.min) + ", " + toText(bounds.max) + "]" +
         unit;
}

std::string demand(const Bounds& bounds, const std::string& unit) {
  return textOf(bounds, unit, "must be ", "must lie ");
}

}  // namespace

XmlReader::XmlReader(const XmlElement& element, std::string file, ErrorList& errors)
    : element_(&element), file_(std::make_shared<const std::string>(std::move(file))), errors_(&errors) {}

bool XmlReader::has(const std::string& setting) const {
  for (const auto& [name, value] : element_->attributes) {
    if (name == setting) return true;
  }
  for (const auto& child : element_->children) {
    if (child.name == setting) return true;
  }
  return false;
}

bool XmlReader::markRead(const std::string& setting) {
  if (isRead(setting)) return false;
  read_settings_.push_back(setting);
  return true;
}

bool XmlReader::isRead(const std::string& setting) const {
  return std::find(read_settings_.begin(), read_settings_.end(), setting) != read_settings_.end();
}

std::optional<XmlReader::Found> XmlReader::find(const std::string& setting) {
  const bool is_first_read = markRead(setting);
  std::optional<Found> found;
  for (const auto& [name, value] : element_->attributes) {
    if (name == setting) found.emplace(Found{value, element_->line.number, &name});
  }
  for (const auto& child : element_->children) {
    if (child.name != setting) continue;
    if (found) {
      if (is_first_read) XmlReader(child, *this).error("is given twice in <" + element_->name + ">; keep one");
      break;
    }
    found.emplace(Found{child.text, child.line.number, nullptr});
    // A value has only text; attributes and children in it are reported as unknown.
    if (!is_first_read || (child.children.empty() && child.attributes.empty())) continue;
    XmlReader inner(child, *this);
    inner.markRead("");
    inner.finish();
  }
  return found;
}

void XmlReader::reportError(const Found& found, const std::string& setting, const std::string& fault) {
  errors_->add(
      *file_, found.line,
      (found.attribute ? "<" + quotable(element_->name) + " " + *found.attribute + "=\"" + quotable(found.text) + "\">"
                       : "<" + setting + ">" + quotable(found.text) + "</" + setting + ">") +
          fault);
}

std::optional<double> XmlReader::checked(const Found& found, const std::string& setting, const Bounds& bounds,
                                         const std::function<std::string()>& fix) {
  const auto value = parseNumber(found.text);
  std::string fault;
  if (!value) {
    fault = found.text.empty() ? "a number is missing" : "is not a number";
  } else if (!std::isfinite(*value)) {
    fault = "must be a finite number";
  } else if (!bounds.contain(*value)) {
    fault = demand(bounds, unitOf(setting));
  } else {
    return value;
  }
  reportError(found, setting, ": " + fault + fix());
  return std::nullopt;
}

void XmlReader::describe(const std::string& setting, const std::string& values, const std::string& default_text) {
  if (settings_) settings_->push_back({around_ + setting, values, default_text});
}

void XmlReader::describe(const std::string& setting, const Bounds& bounds, const std::string& default_text) {
  if (settings_) describe(setting, textOf(bounds, unitOf(setting), "", ""), default_text);
}

double XmlReader::number(const std::string& setting, Bounds bounds) { return length(setting, bounds, 1); }

double XmlReader::length(const std::string& setting, Bounds bounds, double unit_m) {
  const auto found = find(setting);
  if (!found) {
    describe(setting, bounds, "");
    error("<" + setting + "> is missing; add it");
  } else if (checked(*found, setting, bounds, [] { return "; write a number there"; })) {
    return toNumber(found->text, unit_m);
  }
  return (bounds.contain(1) ? 1 : bounds.max) * unit_m;
}

double XmlReader::number(const std::string& setting, Bounds bounds, double default_value) {
  return length(setting, bounds, 1, default_value);
}

double XmlReader::length(const std::string& setting, Bounds bounds, double unit_m, double default_m) {
  const auto found = find(setting);
  if (!found) {
    if (settings_) describe(setting, bounds, toText(default_m, unit_m));
    return default_m;
  }
  const auto fix = [&] { return "; drop it for the default, " + toText(default_m, unit_m); };
  return checked(*found, setting, bounds, fix) ? toNumber(found->text, unit_m) : default_m;
}

double XmlReader::angle(const std::string& setting, Bounds bounds_deg, double default_rad) {
  const auto found = find(setting);
  if (!found) {
    if (settings_) describe(setting, bounds_deg, toText(default_rad, kRadPerDeg));
    return default_rad;
  }
  const auto fix = [&] { return "; drop it for the default, " + toText(default_rad, kRadPerDeg); };
  const auto value_deg = checked(*found, setting, bounds_deg, fix);
  return value_deg ? *value_deg * kRadPerDeg : default_rad;
}

std::string XmlReader::word(const std::string& setting) {
  const auto found = find(setting);
  if (!found) {
    describe(setting, "a word", "");
    error("<" + setting + "> is missing; add it");
  } else if (found->text.empty()) {
    reportError(*found, setting, ": is empty; write a word there");
  } else {
    return found->text;
  }
  return "";
}

std::string XmlReader::word(const std::string& setting, const std::string& default_value) {
  if (has(setting)) return word(setting);
  markRead(setting);
  describe(setting, "a word", default_value.empty() ? "none" : default_value);
  return default_value;
}

std::string XmlReader::attribute(const std::string& name, const std::string& values) {
  markRead(name);
  describe(name, values, "none");
  for (const auto& [own_name, value] : element_->attributes) {
    if (own_name == name) return value;
  }
  return "";
}

bool XmlReader::flag(const std::string& setting, bool default_value) {
  return choice<bool>(setting, {{"0", false}, {"1", true}}, default_value);
}

std::vector<double> XmlReader::numbers(const std::string& setting, std::size_t count, Bounds bounds,
                                       const std::vector<double>& default_value) {
  const auto found = find(setting);
  if (!found) {
    std::string default_text;
    for (const double value : default_value) default_text += (default_text.empty() ? "" : " ") + toText(value);
    describe(setting, std::to_string(count) + " numbers " + textOf(bounds, unitOf(setting), "", ""), default_text);
    return default_value;
  }
  std::istringstream words(found->text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = parseNumber(word);
    if (!value || !std::isfinite(*value) || !bounds.contain(*value)) {
      reportError(*found, setting,
                  ": '" + quotable(word) + "' is no number that fits; it " + demand(bounds, unitOf(setting)));
      return default_value;
    }
    values.push_back(*value);
  }
  if (values.size() == count) return values;
  reportError(*found, setting, ": has " + std::to_string(values.size()) + " numbers; write " + std::to_string(count));
  return default_value;
}

std::optional<XmlReader> XmlReader::child(const std::string& tag) {
  auto found = all(tag);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) found[1].error("is given twice in <" + element_->name + ">; keep one");
  return std::move(found.front());
}

XmlReader XmlReader::requiredChild(const std::string& tag) {
  if (auto found = child(tag)) return *found;
  error("<" + tag + "> is missing; add it");
  // The errors of the missing element's own settings are discarded.
  static thread_local ErrorList discarded;
  discarded = {};
  return {kNothing, *file_, discarded};
}

std::vector<XmlReader> XmlReader::all(const std::string& tag) {
  markRead(tag);
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) {
    if (child.name == tag) found.push_back(XmlReader(child, *this));
  }
  if (settings_ && found.empty()) found.push_back(XmlReader(kNothing, *this));
  if (settings_) {
    for (auto& reader : found) reader.around_ = around_ + tag + "/";
  }
  return found;
}

std::vector<XmlReader> XmlReader::all() {
  all_read_ = true;
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) found.push_back(XmlReader(child, *this));
  return found;
}

void XmlReader::error(const std::string& what) {
  errors_->add(*file_, element_->line.number, "<" + quotable(element_->name) + ">: " + what);
}

void XmlReader::errorAt(const std::string& setting, const std::string& what) {
  if (const auto found = find(setting)) {
    reportError(*found, setting, ": " + what);
  } else {
    error(what);
  }
}

void XmlReader::finish() {
  const auto fix = [&] {
    std::sort(read_settings_.begin(), read_settings_.end());
    std::string accepted;
    for (const auto& name : read_settings_) {
      if (!name.empty()) accepted += (accepted.empty() ? "" : ", ") + name;
    }
    return accepted.empty() ? "; nothing but text is accepted here" : "; accepted here are: " + accepted;
  };
  for (const auto& [name, value] : element_->attributes) {
    if (!isRead(name)) error("unknown attribute " + quotable(name) + "=\"" + quotable(value) + "\"" + fix());
  }
  for (const auto& child : element_->children) {
    if (!all_read_ && !isRead(child.name)) {
      errors_->add(*file_, child.line.number,
                   "<" + quotable(child.name) + ">: unknown tag in <" + quotable(element_->name) + ">" + fix());
    }
  }
  // "" is marked as read where the text is the value.
  if (!element_->text.empty() && !isRead("")) {
    error("the text '" + quotable(element_->text) + "' has no meaning here; take it out");
  }
}

}  // namespace robosim
