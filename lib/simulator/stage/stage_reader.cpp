#include "stage/stage_reader.h"

#include "base/angle_units.h"
#include "base/portable_pose.h"
#include "base/printable_text.h"

namespace robosim::stage {

Pose compose(const Pose& a_from_b, const Pose& b_from_c) {
  return {portable::compose(a_from_b.plan, b_from_c.plan), a_from_b.z_m + b_from_c.z_m};
}

Units Units::of(const Entity& world) {
  const Units plain{1, kRadPerDeg};
  const PropertyReader reader(world, plain);
  Units units = plain;
  const auto choose = [&](const char* name, const std::vector<std::pair<std::string, double>>& known, double& unit) {
    const Property* property = reader.find(name);
    if (!property) return;
    const std::string text = reader.text(name, "");
    std::string names;
    for (const auto& [known_name, value] : known) {
      if (text == known_name) {
        unit = value;
        return;
      }
      names += (names.empty() ? "" : ", ") + known_name;
    }
    PropertyReader::fail(*property, "is '" + quotable(text) + "'; it must be one of: " + names);
  };
  choose("unit_length", {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}}, units.length_m);
  choose("unit_angle", {{"degrees", kRadPerDeg}, {"radians", 1}}, units.angle_rad);
  return units;
}

void Notes::add(const Place& place, const std::string& text) {
  const auto [found, is_new] = index_.try_emplace({place.file ? *place.file : "", text}, notes_.size());
  if (is_new) notes_.push_back({place, text, {}});
  notes_[found->second].at.insert(place.line);
}

void Notes::ignored(const Property& property, const std::string& reason) {
  std::string plain = reason;  // which may be a text of a page
  std::erase(plain, '`');
  add(property.place, quotable(property.name) + " is ignored, because " + plain);
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> lines;
  for (const auto& note : notes_) {
    std::string line = note.first.text() + ": " + note.text;
    if (const std::size_t more = note.at.size() - 1; more > 0) {
      line += "; " + std::to_string(more) + (more == 1 ? " line more" : " lines more");
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void PropertyReader::fail(const Property& property, const std::string& what) {
  throw ConfigError(property.place.text() + ": '" + quotable(property.name) + "' " + what);
}

const Property* PropertyReader::find(const std::string& name) const {
  const auto found = entity_->properties.find(name);
  if (found == entity_->properties.end()) return nullptr;
  found->second->is_used = true;
  return found->second.get();
}

const Property* PropertyReader::one(const std::string& name, TokenKind kind, const char* what) const {
  const Property* property = find(name);
  if (property && (property->values.empty() || property->values[0].kind != kind)) {
    fail(*property, std::string("must be ") + what);
  }
  return property;
}

double PropertyReader::number(const std::string& name, double otherwise) const {
  const Property* property = one(name, TokenKind::number, "a number");
  return property ? property->values[0].number : otherwise;
}

double PropertyReader::length(const std::string& name, double otherwise_m) const {
  return has(name) ? number(name, 0) * units_->length_m : otherwise_m;
}

double PropertyReader::angle(const std::string& name, double otherwise_rad) const {
  return has(name) ? number(name, 0) * units_->angle_rad : otherwise_rad;
}

std::string PropertyReader::text(const std::string& name, const std::string& otherwise) const {
  const Property* property = one(name, TokenKind::text, "a string in \"quotation marks\"");
  return property ? property->values[0].text : otherwise;
}

std::vector<std::string> PropertyReader::texts(const std::string& name) const {
  std::vector<std::string> texts;
  const Property* property = find(name);
  if (!property) return texts;
  for (const auto& value : property->values) {
    if (value.kind != TokenKind::text) fail(*property, "must consist of strings in \"quotation marks\"");
    texts.push_back(value.text);
  }
  return texts;
}

std::vector<double> PropertyReader::numbers(const std::string& name, std::size_t least) const {
  std::vector<double> numbers;
  const Property* property = find(name);
  if (!property) return numbers;
  for (const auto& value : property->values) {
    if (value.kind != TokenKind::number) fail(*property, "must consist of numbers");
    numbers.push_back(value.number);
  }
  if (numbers.size() < least) {
    fail(*property, "has too few numbers; it must have " + std::to_string(least) + " or more, as in [" +
                        (least == 2 ? "1 2" : "1 2 0") + "]");
  }
  return numbers;
}

Pose PropertyReader::pose(const std::string& name) const {
  const auto given = numbers(name, 3);
  if (given.empty()) return {};
  const double unit = units_->length_m;
  const mrpt::math::TPose2D plan(given[0] * unit, given[1] * unit, given.back() * units_->angle_rad);
  if (given.size() == 3) return {plan, 0};
  return {{plan.x, plan.y, given[3] * units_->angle_rad}, given[2] * unit};
}

Size PropertyReader::size(const Size& otherwise) const {
  const auto given = numbers("size", 2);
  if (given.empty()) return otherwise;
  const double unit = units_->length_m;
  const Size size{given[0] * unit, given[1] * unit, given.size() > 2 ? given[2] * unit : otherwise.z};
  if (!(size.x >= 0) || !(size.y >= 0) || !(size.z >= 0)) fail(*find("size"), "must not be negative");
  return size;
}

}  // namespace robosim::stage
