#include "ui/texts.hpp"

#include "base/table.hpp"
#include "ui/data.hpp"

#include <utility>

namespace axil::ui {
namespace {

/// What stands at {1}, {2} of a message; a name in quotes is one that the user or a file gave, which no table may reword.
struct Said {
  std::string text;
  bool isName = false;
};
using Filling = std::map<char, Said>;

/// Where the next {1} to {9} of a pattern begins; other braces are a grammar's own.
std::size_t nextPlace(std::string_view pattern) {
  for (std::size_t at = pattern.find('{'); at != std::string_view::npos; at = pattern.find('{', at + 1))
    if (at + 2 < pattern.size() && pattern[at + 1] >= '1' && pattern[at + 1] <= '9' && pattern[at + 2] == '}') return at;
  return std::string_view::npos;
}

/// What `message` has at the places of `pattern`, where it is that message. A place takes as little as it can.
std::optional<Filling> fillingOf(std::string_view pattern, std::string_view message) {
  Filling filling;
  while (true) {
    const std::size_t place = nextPlace(pattern);
    if (message.substr(0, place) != pattern.substr(0, place)) return std::nullopt;
    if (place == std::string_view::npos) return filling;
    const char number = pattern[place + 1];
    const char quote = place > 0 ? pattern[place - 1] : ' ';
    const bool isName = quote == '\'' || quote == '"';
    message.remove_prefix(place);
    pattern.remove_prefix(place + 3);
    const std::size_t following = nextPlace(pattern);
    const std::string_view next = pattern.substr(0, following);
    const std::size_t end = next.empty() ? message.size() : following == std::string_view::npos ? message.rfind(next) : message.find(next);
    if (end == std::string_view::npos || end == 0) return std::nullopt;
    const std::string_view said = message.substr(0, end);
    if (isName && said.find(quote) != std::string_view::npos) return std::nullopt;  // it ran on over the end of the name
    filling[number] = {std::string(said), isName};
    message.remove_prefix(end);
  }
}

Result<std::vector<Message>> readMessages() {
  const auto table = readTable(data::messages, "messages.tsv");
  if (!table) return table.failure();
  std::vector<Message> messages;
  for (const Table::Row& row : table->rows)
    messages.push_back({table->cell(row, "en"), table->cell(row, "zh_hant"), table->cell(row, "zh_hans")});
  return messages;
}

}  // namespace

Result<Texts> Texts::load() {
  const auto table = readTable(data::texts, "texts.tsv");
  if (!table) return table.failure();
  Texts texts;
  for (const Table::Row& row : table->rows)
    texts.rows_[table->cell(row, "key")] = {{Language::English, table->cell(row, "en")},
                                            {Language::TraditionalChinese, table->cell(row, "zh_hant")},
                                            {Language::SimplifiedChinese, table->cell(row, "zh_hans")}};
  auto messages = readMessages();
  if (!messages) return messages.failure();
  texts.messages_ = std::move(*messages);
  return texts;
}

std::string Texts::translated(std::string_view message, Language language) const {
  if (language == Language::English) return std::string(message);
  for (const Message& known : messages_) {
    const auto filling = fillingOf(known.english, message);
    if (!filling) continue;
    std::string text = language == Language::TraditionalChinese ? known.traditional : known.simplified;
    for (const auto& [number, said] : *filling) text = filled(text, {{std::string_view(&number, 1), said.isName ? said.text : translated(said.text, language)}});
    return text;
  }
  return std::string(message);
}

const char* Texts::operator()(std::string_view key, Language language) const {
  const auto row = rows_.find(key);
  return row == rows_.end() ? key.data() : row->second.at(language).c_str();
}

std::string Texts::allCharacters() const {
  std::string all;
  for (const auto& [key, row] : rows_)
    for (const auto& [language, text] : row) all += text;
  for (const Message& message : messages_) all += message.traditional + message.simplified;
  return all;
}

std::string filled(std::string_view pattern, std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string text(pattern);
  for (const auto& [name, value] : values) {
    const std::string place = "{" + std::string(name) + "}";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size())) text.replace(at, place.size(), value);
  }
  for (const auto& [name, value] : values) {
    const std::string choice = "{" + std::string(name) + "=1:";
    for (std::size_t at = text.find(choice); at != std::string::npos; at = text.find(choice, at)) {
      const std::size_t bar = text.find('|', at), end = text.find('}', at);
      if (end == std::string::npos || bar > end) break;
      const std::size_t one = at + choice.size();
      text.replace(at, end + 1 - at, value == "1" ? text.substr(one, bar - one) : text.substr(bar + 1, end - bar - 1));
    }
  }
  return text;
}

}  // namespace axil::ui
