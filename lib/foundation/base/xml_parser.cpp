#include "base/xml_parser.h"

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <expat.h>
#include <iconv.h>
#include <strings.h>

#include "base/error_list.h"
#include "base/printable_text.h"

namespace robosim {
namespace {

constexpr std::size_t kMaxDepth = 98;

std::string_view trimmed(std::string_view text) {
  const char* white = " \t\r\n";
  const auto first = text.find_first_not_of(white);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(white) - first + 1);
}

ConfigError at(const std::string& file, int line, const std::string& what) {
  return ConfigError(file + ":" + std::to_string(line) + ": " + what);
}

/// A byte order mark, or the initial '<' of an XML document in two bytes.
bool isUtf16(std::string_view text) {
  const std::string_view begin = text.substr(0, 2);
  return begin == "\xff\xfe" || begin == "\xfe\xff" || begin == std::string_view("<\0", 2) ||
         begin == std::string_view("\0<", 2);
}

/// Limits the number of elements, each of which needs a few hundred bytes in memory, and of attributes of an element,
/// which the parser compares in pairs. Both are counted before parsing: each '<' that does not begin an end tag, a
/// declaration, a comment or an instruction, and the quotation marks between two '<'.
void refuseBloated(const std::string& text, const std::string& file) {
  constexpr std::size_t max_elements = 4'000'000;
  constexpr std::size_t max_quotes = 2'000;
  std::size_t elements = 0, quotes = 0;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == '"' || c == '\'') ++quotes;
    if (c == '<') {
      const char next = i + 1 < text.size() ? text[i + 1] : '\0';
      if (next != '/' && next != '!' && next != '?') ++elements;
      quotes = 0;
    }
    if (elements > max_elements) throw at(file, line, "more than 4 million elements; split the file");
    if (quotes > max_quotes) throw at(file, line, "an element with more than 1000 attributes; is this a world file?");
  }
}

/// Expat handler for encodings without built-in support: fills in the character of each byte. Accepts only common 8-bit
/// encodings, so that untrusted input cannot select any of iconv's.
int mapUnknownEncoding(void*, const char* name, XML_Encoding* encoding) {
  const auto is_one = [&](std::string_view family) { return strncasecmp(name, family.data(), family.size()) == 0; };
  constexpr std::string_view families[] = {"ISO-8859-", "windows-125", "CP125", "KOI8-"};
  if (std::none_of(std::begin(families), std::end(families), is_one)) return XML_STATUS_ERROR;
  const iconv_t converter = iconv_open("UCS-4LE", name);
  if (converter == reinterpret_cast<iconv_t>(-1)) return XML_STATUS_ERROR;
  for (int byte = 0; byte < 256; ++byte) {
    char in = static_cast<char>(byte);
    char* from = &in;
    std::size_t left = 1;
    std::array<unsigned char, 4> code_point{};
    char* to = reinterpret_cast<char*>(code_point.data());
    std::size_t room = code_point.size();
    iconv(converter, nullptr, nullptr, nullptr, nullptr);
    const bool is_known = iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1) && room == 0;
    encoding->map[byte] = is_known ? code_point[0] | code_point[1] << 8 | code_point[2] << 16 : -1;
  }
  iconv_close(converter);
  encoding->convert = nullptr;
  encoding->release = nullptr;
  return XML_STATUS_OK;
}

/// Builds the elements of one document from Expat's events, without an intermediate tree.
class Document {
 public:
  Document(const std::string& text, const std::string& file) : text_(text), file_(file) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetUnknownEncodingHandler(parser_.get(), mapUnknownEncoding, nullptr);
    XML_SetElementHandler(
        parser_.get(),
        [](void* of, const char* name, const char** attributes) {
          doIn(of, [&](Document& document) { document.open(name, attributes); });
        },
        [](void* of, const char*) { doIn(of, [](Document& document) { document.close(); }); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* of, const char* more, int size) {
      doIn(of, [&](Document& document) { document.addText({more, static_cast<std::size_t>(size)}); });
    });
  }

  XmlElement read() {
    const auto status = XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), XML_TRUE);
    if (failure_) std::rethrow_exception(failure_);
    if (status != XML_STATUS_OK) throw at(file_, line(), fault());
    return std::move(done_.front());
  }

 private:
  struct Open {
    XmlElement element;
    std::size_t first_child;  ///< index in done_
  };

  /// Calls a function without letting its exceptions propagate through Expat, which is written in C.
  template <typename Work>
  static void doIn(void* of, const Work& work) {
    auto& document = *static_cast<Document*>(of);
    try {
      work(document);
    } catch (...) {
      document.failure_ = std::current_exception();
      XML_StopParser(document.parser_.get(), XML_FALSE);
    }
  }

  void open(const char* name, const char** attributes) {
    if (open_.size() == kMaxDepth) {
      throw at(file_, line(), withFix("elements lie more than 98 deep"));
    }
    XmlElement element{.name = name, .text = {}, .attributes = {}, .children = {}, .line = {line()}};
    for (; *attributes; attributes += 2) element.attributes.emplace_back(attributes[0], trimmed(attributes[1]));
    open_.push_back({std::move(element), done_.size()});
  }

  void addText(std::string_view more) {
    std::string& text = open_.back().element.text;
    if (!text.empty() || !trimmed(more).empty()) text += more;
  }

  void close() {
    auto [element, first_child] = std::move(open_.back());
    open_.pop_back();
    if (const auto text = trimmed(element.text); text.size() != element.text.size()) element.text = std::string(text);
    const auto children = done_.begin() + static_cast<std::ptrdiff_t>(first_child);
    // Avoids spare capacity: the file of a large world has millions of elements.
    element.children.assign(std::move_iterator(children), std::move_iterator(done_.end()));
    done_.erase(children, done_.end());
    done_.push_back(std::move(element));
  }

  int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_.get())); }

  /// Description of the error at the parser's position, and how to fix it.
  std::string fault() const {
    const auto position = static_cast<std::size_t>(std::max<XML_Index>(0, XML_GetCurrentByteIndex(parser_.get())));
    const auto before = std::string_view(text_).substr(0, position);
    const auto rest = std::string_view(text_).substr(before.size());
    if (rest.starts_with("<!--")) return withFix("a comment is not closed by -->");
    const bool is_declaration = before.ends_with("<!") || (rest.starts_with("<!") && !rest.starts_with("<![CDATA["));
    if (is_declaration) return "a <!…> declaration has no place here; take it out";
    switch (XML_GetErrorCode(parser_.get())) {
      case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
        if (!rest.starts_with('<')) break;
        return "a second root element " + quotable(rest.substr(0, rest.find_first_of(" \t\r\n/>", 1))) +
               ">; an XML file has one";
      case XML_ERROR_NO_ELEMENTS:
        if (open_.empty()) return "there is no element in the file";
        [[fallthrough]];
      case XML_ERROR_TAG_MISMATCH:
        return withFix("an element is closed by another's tag, or not at all (was the file cut off?)");
      case XML_ERROR_MISPLACED_XML_PI:
        return "<?xml …?> must be at the start of the file; remove what precedes it";
      case XML_ERROR_UNDEFINED_ENTITY:
        return quotable(rest.substr(0, rest.find(';'))) + "; stands for nothing; write the character itself";
      case XML_ERROR_UNKNOWN_ENCODING:
      case XML_ERROR_INCORRECT_ENCODING:
        return "the encoding that the file names is not known, or not that of the file; save it as UTF-8";
      case XML_ERROR_DUPLICATE_ATTRIBUTE:
        return withFix(kAttribute);
      case XML_ERROR_BAD_CHAR_REF:
        return quotable(rest.substr(0, rest.find(';'))) +
               "; stands for a character that XML does not allow; take it out";
      case XML_ERROR_INVALID_TOKEN: {
        if (!rest.empty() && static_cast<unsigned char>(rest[0]) < 0x20 &&
            std::string_view("\t\r\n").find(rest[0]) == std::string_view::npos) {
          return "the control character " + printableText(rest.substr(0, 1)) + " is not allowed in XML; take it out";
        }
        if (!rest.empty() && static_cast<unsigned char>(rest[0]) >= 0x80) {
          return "a character is not in the file's encoding, which is UTF-8 unless it names another; save it as UTF-8";
        }
        if (before.ends_with('&') || rest.starts_with('&')) return "an & that is meant as such is written &amp; in XML";
        const auto tag = before.find_last_of("<>");
        if (tag != std::string_view::npos && before[tag] == '<' &&
            before.find_first_of(" \t\r\n", tag) != std::string_view::npos) {
          return withFix(kAttribute);
        }
        break;
      }
      default:
        break;
    }
    return withFix("this is not XML, or the file was cut off");
  }

  static std::string withFix(const char* what) { return what + std::string("; fix the file here or just before"); }
  static constexpr const char* kAttribute = "an attribute is given twice, or is not name=\"value\"";

  const std::string& text_;
  const std::string& file_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_{XML_ParserCreate(nullptr), &XML_ParserFree};
  std::vector<Open> open_;        ///< the root first
  std::vector<XmlElement> done_;  ///< children of the open ones; those of the root first
  std::exception_ptr failure_;
};

}  // namespace

XmlElement parseXml(std::string text, const std::string& file) {
  if (trimmed(text).empty()) throw at(file, 1, "the file is empty; an XML document was expected");
  if (isUtf16(text)) throw at(file, 1, "the file is in the encoding UTF-16; save it as UTF-8");
  if (text.find('\0') != std::string::npos) throw at(file, 1, "this is not XML: it holds a zero byte");
  refuseBloated(text, file);
  // A DOCTYPE is detected before parsing, so that the error names the entities and not a later '>'.
  if (const auto doctype = text.find("<!DOCTYPE"); doctype != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(doctype), '\n');
    throw at(file, static_cast<int>(line), "a DOCTYPE (and with it entities) is not accepted; take it out");
  }
  XmlElement root = Document(text, file).read();
  std::string().swap(text);  // frees up to 100 MB before the elements are used
  return root;
}

}  // namespace robosim
