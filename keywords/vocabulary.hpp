#pragma once
/// \file
/// The vocabulary: which words say which concept. It is data (keywords/data/*.tsv, one table a category, compiled in), so a
/// botanist extends it without touching code. docs/keywords.md lists it for readers.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace axil::keywords {

/// A word or phrase of one concept. `everyday` words (opposite, round) count only where an organ is named in the sentence.
struct Term {
  std::string words;
  bool everyday = false;
};

struct Concept {
  std::string name;  ///< its English name, unique in its category
  std::vector<Term> english;
  std::vector<Term> traditional;
  std::vector<Term> simplified;
  std::string definition;
  std::map<std::string, std::string> columns;  ///< what else the table says, by column name
};

/// One table. Organs, units and dimensions are categories too: they are what statements are about and measured in.
struct Category {
  std::string property;      ///< "arrangement", "shape"; the property of the traits that it yields
  std::string defaultOrgan;  ///< the organ a statement is about when none is named; "leaf"
  std::string part;          ///< the part of the organ it is about ("margin"); empty: the whole organ
  bool ownOrgan = false;     ///< always about the default organ, whatever is named: a kind of fruit is about the fruit
  std::vector<std::string> organs;     ///< the organs such a statement can be about; empty: all
  std::vector<std::string> notOrgans;  ///< and those it cannot be about
  std::vector<Concept> concepts;
};

[[nodiscard]] const std::vector<Category>& vocabulary();
/// The first category of that property; it must exist. (Leaves, inflorescences and fruits each have a "type".)
[[nodiscard]] const Category& categoryOf(std::string_view property);

}  // namespace axil::keywords
