#include "base/xml_reader.h"

#include <algorithm>
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
                                                       {"_rad", " radians"},
                                                       {"_px", " pixels"},
                                                       {"_hz", " hertz"}};
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

bool XmlReader::ask(const std::string& setting) {
  if (isAsked(setting)) return false;
  asked_.push_back(setting);
  return true;
}

bool XmlReader::isAsked(const std::string& setting) const {
  return std::find(asked_.begin(), asked_.end(), setting) != asked_.end();
}

std::optional<XmlReader::Found> XmlReader::find(const std::string& setting) {
  const bool is_news = ask(setting);
  std::optional<Found> found;
  for (const auto& [name, value] : element_->attributes) {
    if (name == setting) found.emplace(Found{value, element_->line.number, &name});
  }
  for (const auto& child : element_->children) {
    if (child.name != setting) continue;
    if (found) {
      if (is_news) XmlReader(child, *this).error("is given twice in <" + element_->name + ">; keep one");
      break;
    }
    found.emplace(Found{child.text, child.line.number, nullptr});
    // A value holds text only; anything else inside it is an unknown tag like any other.
    if (!is_news || (child.children.empty() && child.attributes.empty())) continue;
    XmlReader inner(child, *this);
    inner.ask("");
    inner.finish();
  }
  return found;
}

void XmlReader::reportFault(const Found& found, const std::string& setting, const std::string& fault) {
  errors_->add(*file_, found.line,
               (found.attribute ? "<" + element_->name + " " + *found.attribute + "=\"" + found.text + "\">"
                                : "<" + setting + ">" + found.text + "</" + setting + ">") +
                   fault);
}

std::optional<double> XmlReader::checked(const Found& found, const std::string& setting, const Bounds& bounds,
                                         const std::function<std::string()>& mend) {
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
  reportFault(found, setting, ": " + fault + mend());
  return std::nullopt;
}

double XmlReader::number(const std::string& setting, Bounds bounds) { return length(setting, bounds, 1); }

double XmlReader::length(const std::string& setting, Bounds bounds, double unit_m) {
  const auto found = find(setting);
  if (!found) {
    error("<" + setting + "> is missing; add it");
  } else if (checked(*found, setting, bounds, [] { return "; write a number there"; })) {
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
  const auto mend = [&] { return "; drop it for the default, " + toText(otherwise_m, unit_m); };
  return checked(*found, setting, bounds, mend) ? toNumber(found->text, unit_m) : otherwise_m;
}

double XmlReader::angle(const std::string& setting, Bounds bounds_deg, double otherwise_rad) {
  const auto found = find(setting);
  if (!found) return otherwise_rad;
  const auto mend = [&] { return "; drop it for the default, " + toText(otherwise_rad, kRadPerDeg); };
  const auto value_deg = checked(*found, setting, bounds_deg, mend);
  return value_deg ? *value_deg * kRadPerDeg : otherwise_rad;
}

std::string XmlReader::word(const std::string& setting) {
  const auto found = find(setting);
  if (!found) {
    error("<" + setting + "> is missing; add it");
  } else if (found->text.empty()) {
    reportFault(*found, setting, ": is empty; write a word there");
  } else {
    return found->text;
  }
  return "";
}

std::string XmlReader::word(const std::string& setting, const std::string& otherwise) {
  if (has(setting)) return word(setting);
  ask(setting);
  return otherwise;
}

bool XmlReader::flag(const std::string& setting, bool otherwise) {
  return choice<bool>(setting, {{"0", false}, {"1", true}}, otherwise);
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
      reportFault(*found, setting, ": '" + word + "' is no number that fits; it " + describe(bounds, unitOf(setting)));
      return otherwise;
    }
    values.push_back(*value);
  }
  if (values.size() == count) return values;
  reportFault(*found, setting, ": has " + std::to_string(values.size()) + " numbers; write " + std::to_string(count));
  return otherwise;
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
  // The missing element's own missing settings are no news: its reader reports to nobody.
  static thread_local ErrorList nobody;
  nobody = {};
  return {kNothing, *file_, nobody};
}

std::vector<XmlReader> XmlReader::all(const std::string& tag) {
  ask(tag);
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) {
    if (child.name == tag) found.push_back(XmlReader(child, *this));
  }
  return found;
}

std::vector<XmlReader> XmlReader::all() {
  all_asked_ = true;
  std::vector<XmlReader> found;
  for (const auto& child : element_->children) found.push_back(XmlReader(child, *this));
  return found;
}

void XmlReader::error(const std::string& what) {
  errors_->add(*file_, element_->line.number, "<" + element_->name + ">: " + what);
}

void XmlReader::errorAt(const std::string& setting, const std::string& what) {
  if (const auto found = find(setting)) {
    reportFault(*found, setting, ": " + what);
  } else {
    error(what);
  }
}

void XmlReader::finish() {
  const auto mend = [&] {
    std::sort(asked_.begin(), asked_.end());
    std::string accepted;
    for (const auto& name : asked_) {
      if (!name.empty()) accepted += (accepted.empty() ? "" : ", ") + name;
    }
    return accepted.empty() ? "; nothing but text is accepted here" : "; accepted here are: " + accepted;
  };
  for (const auto& [name, value] : element_->attributes) {
    if (!isAsked(name)) error("unknown attribute " + name + "=\"" + value + "\"" + mend());
  }
  for (const auto& child : element_->children) {
    if (!all_asked_ && !isAsked(child.name)) {
      errors_->add(*file_, child.line.number, "<" + child.name + ">: unknown tag in <" + element_->name + ">" + mend());
    }
  }
  // "" is asked for where the text is the value.
  if (!element_->text.empty() && !isAsked("")) {
    error("the text '" + element_->text.substr(0, 40) + "' has no meaning here; take it out");
  }
}

}  // namespace robosim
