#include "base/html_table.h"

#include <cmath>

#include "base/html_text.h"
#include "base/text_table.h"

namespace robosim {

HtmlTable::HtmlTable(std::vector<std::string> names, bool kept) : names_(std::move(names)), is_second_kept_(kept) {}

void HtmlTable::addGroups(const std::vector<std::pair<std::string, int>>& spans) {
  for (const auto& [name, columns] : spans) {
    groups_ += (name.empty() ? "<td" : "<th scope=colgroup class=group") +
               (columns == 1 ? "" : " colspan=" + std::to_string(columns)) + ">" + escapedHtml(name);
  }
}

// Without the end tags and quotation marks that HTML does not need: a report has tens of thousands of cells.
void HtmlTable::add(const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) rows_ += (i == 0 ? "<tr><th scope=row>" : "<td>") + cells[i];
  rows_ += "\n";
}

std::string HtmlTable::html() const {
  std::string html =
      std::string("<div class=wide tabindex=0><table") + (is_second_kept_ ? " class=two" : "") + "><thead>";
  if (!groups_.empty()) html += "<tr>" + groups_;
  html += "<tr>";
  for (const auto& name : names_) html += "<th scope=col>" + escapedHtml(name);
  return html + "<tbody>\n" + rows_ + "</table></div>\n";
}

std::string numberCell(double value, int decimals) {
  if (std::isnan(value)) return "–";
  return std::isfinite(value) ? fixed(value, decimals) : "never";
}

}  // namespace robosim
