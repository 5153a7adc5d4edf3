#include "wire/world_wire.h"

#include <utility>

namespace robosim {

void encode(const WorldSource& source, v1::WorldSource& out) {
  out.Clear();
  out.set_file(source.file);
  out.set_text(source.text);
  for (const auto& [name, type] : source.robot_types) {
    auto& sent = *out.add_robot_types();
    sent.set_name(name);
    sent.set_file(type.file.string());
    sent.set_text(type.text.value_or(""));
  }
  for (const auto& [name, content] : source.files) {
    auto& sent = *out.add_files();
    sent.set_name(name);
    sent.set_content(content);
  }
  if (source.seed) out.set_seed(*source.seed);
}

WorldSource decode(const v1::WorldSource& in) { return decode(v1::WorldSource(in)); }

WorldSource decode(v1::WorldSource&& in) {
  WorldSource source;
  source.file = in.file();
  source.text = std::move(*in.mutable_text());
  for (auto& type : *in.mutable_robot_types()) {
    source.robot_types[type.name()] = {type.file(), std::move(*type.mutable_text())};
  }
  for (auto& file : *in.mutable_files()) source.files[file.name()] = std::move(*file.mutable_content());
  if (in.has_seed()) source.seed = in.seed();
  return source;
}

}  // namespace robosim
