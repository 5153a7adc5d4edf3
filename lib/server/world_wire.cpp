#include "server/world_wire.h"

namespace robosim {

void encode(const WorldSource& source, wire::WorldSource& out) {
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
}

WorldSource decode(const wire::WorldSource& in) {
  WorldSource source;
  source.file = in.file();
  source.text = in.text();
  for (const auto& type : in.robot_types()) source.robot_types[type.name()] = {type.file(), type.text()};
  for (const auto& file : in.files()) source.files[file.name()] = file.content();
  return source;
}

}  // namespace robosim
