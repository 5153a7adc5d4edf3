#include "run_page/page_document.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "base/html_text.h"
#include "run_page/page_bytes.h"

namespace robosim {
namespace {

std::string_view fileNamed(const std::vector<PageFile>& files, std::string_view name) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; });
  if (found == files.end()) throw std::logic_error("the page has no file " + std::string(name));
  return found->bytes;
}

/// One script of all modules, each after those that it imports. Scripts of a file cannot import each other, so that the
/// modules share one scope: names at their top level differ.
class Bundle {
 public:
  explicit Bundle(const std::vector<PageFile>& files) : files_(files) {}

  std::string of(const std::string& main) {
    add(main);
    return std::move(script_);
  }

 private:
  void add(const std::string& name) {
    if (!added_.insert(name).second) return;
    const std::string_view source = fileNamed(files_, name);
    std::string own;
    bool is_import = false;
    for (std::size_t at = 0; at < source.size();) {
      const std::size_t end = std::min(source.find('\n', at), source.size());
      std::string_view line = source.substr(at, end - at);
      at = end + 1;
      is_import |= line.starts_with("import ");
      if (is_import) {
        const std::size_t from = line.find("'./");
        if (from == std::string_view::npos) continue;  // until the line with the name of the file
        is_import = false;
        add(std::string(line.substr(from + 3, line.find('\'', from + 1) - from - 3)));
        continue;
      }
      if (line.starts_with("export ")) line.remove_prefix(7);
      own += line;
      own += '\n';
    }
    script_ += own;
  }

  const std::vector<PageFile>& files_;
  std::set<std::string> added_;
  std::string script_;
};

/// The page with its marks, such as {{title}}, replaced by texts, whose own braces have no meaning.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts) {
  std::string html;
  for (;;) {
    const std::size_t begin = page.find("{{");
    html += page.substr(0, begin);
    if (begin == std::string_view::npos) return html;
    const std::size_t end = page.find("}}", begin);
    if (end == std::string_view::npos) throw std::logic_error("the page has a mark without an end");
    html += texts.at(page.substr(begin + 2, end - begin - 2));
    page.remove_prefix(end + 2);
  }
}

std::string styleOf(const std::vector<PageFile>& files) {
  return std::string(fileNamed(files, "colors.css")) + std::string(fileNamed(files, "style.css"));
}

/// @param style, data, script elements
std::string pageOf(const std::vector<PageFile>& files, const std::string& title, std::string style, std::string data,
                   std::string script) {
  return filled(fileNamed(files, "index.html"), {{"title", escapedHtml(title)},
                                                 {"style", std::move(style)},
                                                 {"licence", escapedHtml(fileNamed(files, "three_licence.txt"))},
                                                 {"script", std::move(script)},
                                                 {"data", std::move(data)}});
}

std::string blockElement(const std::string& id, const std::string& text) {
  return "<script type=\"text/plain\" id=\"" + escapedHtml(id) + "\">" + text + "</script>\n";
}

}  // namespace

std::string runPageDocument(const std::string& title, const std::vector<PageBlock>& blocks) {
  const auto files = runPageFiles();
  std::string data;
  for (const auto& block : blocks) data += blockElement(block.id, block.text);
  data += blockElement("three", base64ForPage(fileNamed(files, "three.min.js.gz")));
  return pageOf(files, title, "<style>\n" + styleOf(files) + "\n</style>", std::move(data),
                "<script type=\"module\">\n" + Bundle(files).of("main.js") + "\n</script>");
}

std::vector<ServedPageFile> servedRunPage(const std::string& title) {
  const auto files = runPageFiles();
  std::string page = pageOf(files, title, "<link rel=\"stylesheet\" href=\"run_page.css\">", "",
                            "<script type=\"module\" src=\"run_page.js\"></script>");
  return {{"/", "text/html; charset=utf-8", std::move(page)},
          {"/run_page.css", "text/css; charset=utf-8", styleOf(files)},
          {"/run_page.js", "text/javascript; charset=utf-8", Bundle(files).of("main.js")},
          {"/three.min.js", "text/javascript; charset=utf-8", gunzipped(fileNamed(files, "three.min.js.gz"))}};
}

}  // namespace robosim
