#pragma once
/// \file
/// Every word that the window shows, in its three languages. The words are data (data/texts.tsv): a key and one column a language.
/// A key that the table lacks shows itself, so that it is noticed and never hides a control.

#include "base/result.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::ui {

enum class Language { English, TraditionalChinese, SimplifiedChinese };

/// A message with places for what changes in it, in each language.
struct Message {
  std::string english;
  std::string traditional;
  std::string simplified;
};

class Texts {
 public:
  /// The built-in table. Fails with BadInput where the table is no table (our own mistake; a test reads it).
  [[nodiscard]] static Result<Texts> load();

  /// The words under `key`, zero-terminated.
  [[nodiscard]] const char* operator()(std::string_view key, Language language) const;
  /// A message of another room, which is English, in `language`: by the table of messages, whose rows have {1}, {2} where a message has
  /// names, numbers or other messages; what stands in quotes is a name and stays. A message that the table does not have stays as it is.
  [[nodiscard]] std::string translated(std::string_view message, Language language) const;
  [[nodiscard]] bool has(std::string_view key) const { return rows_.find(key) != rows_.end(); }
  /// All characters of all languages: what a font must have.
  [[nodiscard]] std::string allCharacters() const;

 private:
  std::map<std::string, std::map<Language, std::string>, std::less<>> rows_;
  std::vector<Message> messages_;
};

/// `pattern` with each {name} replaced; {name=1:this|that} is `this` where the value is 1, else `that`.
[[nodiscard]] std::string filled(std::string_view pattern, std::initializer_list<std::pair<std::string_view, std::string>> values);

}  // namespace axil::ui
