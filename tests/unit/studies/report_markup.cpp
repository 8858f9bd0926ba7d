#include "tests/unit/studies/report_markup.hpp"

#include <cctype>
#include <set>
#include <vector>

namespace dovetail::report {

namespace {

struct Scanner {
  const std::string& text;
  std::size_t at = 0;
  std::vector<std::string> open;
  std::string error;

  bool fail(const std::string& what) {
    if (error.empty()) error = what + " at '" + text.substr(at, 60) + "'";
    return false;
  }
  [[nodiscard]] bool starts(const char* with) const { return text.compare(at, std::string(with).size(), with) == 0; }
  void space() {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  }
  std::string name() {
    const std::size_t begin = at;
    while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '-' ||
                                text[at] == ':' || text[at] == '_'))
      ++at;
    return text.substr(begin, at - begin);
  }
  bool entity() {
    const std::size_t end = text.find(';', at);
    if (end == std::string::npos || end - at > 8 || end == at + 1) return fail("bare &");
    at = end + 1;
    return true;
  }
  bool attributes() {
    std::set<std::string> seen;
    for (space(); at < text.size() && text[at] != '>' && text[at] != '/'; space()) {
      const std::string key = name();
      if (key.empty() || !seen.insert(key).second) return fail("bad or repeated attribute");
      if (!starts("=\"")) return fail("unquoted attribute");
      for (at += 2; at < text.size() && text[at] != '"';) {
        if (text[at] == '<') return fail("bare <");
        if (text[at] == '&' ? !entity() : (++at, false)) return false;
      }
      if (at >= text.size()) return fail("unclosed attribute");
      ++at;
    }
    return true;
  }
  bool element() {
    ++at;
    const std::string tag = name();
    if (tag.empty()) return fail("bare <");
    if (!attributes()) return false;
    if (starts("/>")) {
      at += 2;
      return true;
    }
    if (!starts(">")) return fail("bad tag");
    ++at;
    open.push_back(tag);
    if (tag == "style" || tag == "script") at = std::min(text.find("</" + tag + ">", at), text.size());
    return true;
  }
  bool end_tag() {
    at += 2;
    const std::string tag = name();
    if (open.empty() || open.back() != tag || !starts(">")) return fail("</" + tag + "> does not match");
    ++at;
    open.pop_back();
    return true;
  }
  bool run() {
    while (at < text.size()) {
      if (starts("<!") || starts("<?")) {
        at = text.find('>', at) + 1;
      } else if (starts("</")) {
        if (!end_tag()) return false;
      } else if (text[at] == '<') {
        if (!element()) return false;
      } else if (text[at] == '&') {
        if (!entity()) return false;
      } else {
        ++at;
      }
    }
    return open.empty() || fail("<" + open.back() + "> is not closed");
  }
};

}  // namespace

std::string markup_error(const std::string& text) {
  Scanner scanner{.text = text, .at = 0, .open = {}, .error = {}};
  scanner.run();
  return scanner.error;
}

}  // namespace dovetail::report
