#include "studies/report/pages/page.hpp"

#include "studies/report/texts.hpp"
#include "studies/report/words/html.hpp"

namespace dovetail::report {

std::string fill(std::string_view text, const Blanks& blanks) {
  std::string filled;
  for (std::size_t open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    filled += text.substr(0, open);
    text.remove_prefix(open + 2);
    const std::size_t braces = text.starts_with('{') ? 1 : 0;
    const std::size_t close = text.find("}}");
    std::string name(text.substr(braces, close - braces));
    text.remove_prefix(close + 2 + braces);
    if (!name.starts_with('#') && !name.starts_with('^')) {
      filled += braces == 1 ? blanks.at(name) : escape(blanks.at(name));
      continue;
    }
    const bool where_empty = name.starts_with('^');
    name.erase(0, 1);
    const std::string end = "{{/" + name + "}}";
    const std::size_t length = text.find(end);
    if (blanks.at(name).empty() == where_empty) filled += fill(text.substr(0, length), blanks);
    text.remove_prefix(length + end.size());
  }
  return filled.append(text);
}

std::string page(const std::string& title, std::string_view rules, const std::string& body) {
  const std::string style = std::string(texts::figures_css) + std::string(texts::page_css) + std::string(rules);
  std::string scripts;
  if (body.find("<div class=\"chart\"") != std::string::npos)
    for (const std::string_view script : {texts::echarts_min_js, texts::charts_js, texts::candidates_js})
      scripts.append("<script>\n").append(script).append("</script>\n");
  return fill(texts::page_html, {{"title", title}, {"style", style}, {"body", body}, {"scripts", scripts}});
}

}  // namespace dovetail::report
