// robosim convert: a world of another simulator as files of RoboSim.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "base/xml_parser.h"
#include "robosim/arguments.h"
#include "robosim/subcommands.h"
#include "robots/world_source.h"
#include "run/local_run.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string file, out;
  bool force = false;
};

/// Paths of maps are relative to the world file's folder, which changes.
void moveMaps(XmlElement& element, const fs::path& from, const fs::path& to) {
  for (auto& child : element.children) {
    if (element.name == "map" && child.name == "file" && fs::path(child.text).is_relative()) {
      child.text = fs::absolute(from / child.text).lexically_normal().lexically_relative(to).string();
    }
    moveMaps(child, from, to);
  }
}

void write(const fs::path& file, const std::string& text) {
  AtomicFile written(file);
  written.write(text);
  written.finish();
  written.commit();
}

void convert(const ConvertArguments& arguments) {
  const fs::path out(arguments.out);
  refuseSameFile({{"FILE", arguments.file}, {"OUT", out}});
  if (out.extension() != ".xml")
    throw ConfigError(arguments.out + ": a world of RoboSim ends in .xml; choose such a name");
  StageNotes notes;
  const WorldSource source = readWorldSource(arguments.file, &notes);
  const fs::path folder = fs::absolute(out).lexically_normal().parent_path();

  XmlElement root = parseXml(source.text, source.file);
  moveMaps(root, fs::path(arguments.file).parent_path(), folder);
  std::string text = toXml(root);
  std::string name = printableText(fs::path(arguments.file).filename().string());
  for (auto at = name.find("--"); at != std::string::npos; at = name.find("--", at)) name.replace(at, 2, "-");
  text.insert(text.find('\n') + 1, "<!-- Translated by robosim convert from " + name + " -->\n");

  std::vector<std::pair<fs::path, std::string>> files{{out, text}};
  for (const auto& [type, file] : source.robot_types) {
    files.emplace_back(out.parent_path() / "robots" / (type + ".xml"), file.text.value_or(""));
  }
  for (const auto& [file, content] : files) {
    std::error_code none;
    if (!arguments.force && fs::exists(fs::symlink_status(file, none))) {
      throw ConfigError(file.string() + ": exists already; --force replaces it, or choose another folder");
    }
  }
  if (files.size() > 1) fs::create_directories(out.parent_path() / "robots");
  for (const auto& [file, content] : files) {
    write(file, content);
    std::cout << "written: " << printableText(file.string()) << '\n';
  }
  for (const auto& note : notes.lines) std::cout << "note: " << printableText(note) << '\n';
  try {
    loadWorld(source, checkController);
  } catch (const ConfigError& error) {
    for (const auto& line : error.errors()) std::cout << "to be fixed: " << printableText(line) << '\n';
  }
  const auto& properties = notes.properties;
  std::cout << withCommas(properties.translated) << " of " << withCommas(properties.all) << " properties translated, "
            << withCommas(properties.display) << " of Stage's window and clock, " << withCommas(properties.ignored)
            << " ignored\n";
}

}  // namespace

void addConvert(CLI::App& program) {
  auto* command = addSubcommand(program, "convert");
  auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("FILE", arguments->file, "a world of Stage (.world)")
      ->transform(inputFile({FileKind::stage_world}))
      ->required();
  command
      ->add_option("OUT", arguments->out,
                   "world file to write, NAME.xml; its robot types are written to robots/ beside it")
      ->type_name("FILE")
      ->check(fileName())
      ->required();
  command->add_flag("--force", arguments->force, "replace files that exist");
  command->callback([arguments] { convert(*arguments); });
}

}  // namespace robosim
