#include "ui/texts.hpp"

#include "base/table.hpp"
#include "ui/data.hpp"

namespace axil::ui {

Result<Texts> Texts::load() {
  const auto table = readTable(data::texts, "texts.tsv");
  if (!table) return table.failure();
  Texts texts;
  for (const Table::Row& row : table->rows)
    texts.rows_[table->cell(row, "key")] = {{Language::English, table->cell(row, "en")},
                                            {Language::TraditionalChinese, table->cell(row, "zh_hant")},
                                            {Language::SimplifiedChinese, table->cell(row, "zh_hans")}};
  return texts;
}

const char* Texts::operator()(std::string_view key, Language language) const {
  const auto row = rows_.find(key);
  return row == rows_.end() ? key.data() : row->second.at(language).c_str();
}

std::string Texts::allCharacters() const {
  std::string all;
  for (const auto& [key, row] : rows_)
    for (const auto& [language, text] : row) all += text;
  return all;
}

std::string filled(std::string_view pattern, std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string text(pattern);
  for (const auto& [name, value] : values) {
    const std::string place = "{" + std::string(name) + "}";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size())) text.replace(at, place.size(), value);
  }
  return text;
}

}  // namespace axil::ui
