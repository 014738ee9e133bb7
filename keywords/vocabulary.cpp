#include "keywords/vocabulary.hpp"

#include "base/table.hpp"
#include "keywords/data.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

struct Source {
  std::string_view property;
  std::string_view defaultOrgan;
  std::string_view part;
  std::string_view table;
  bool ownOrgan = false;
  std::vector<std::string> organs = {};
  std::vector<std::string> notOrgans = {};
};

// In the order in which meanings are tried. "erect" is the habit of a stem and the orientation of a pedicel.
std::vector<Source> sources() {
  const std::vector<std::string> bodies{"plant", "stem", "trunk", "rhizome", "pseudobulb"};
  return {
      {"organ", "", "", data::organ},
      {"which", "", "", data::which},
      {"unit", "", "", data::unit},
      {"dimension", "", "", data::dimension},
      {"stop", "", "", data::stop},
      {"foreign", "", "", data::foreign},
      {"habit", "plant", "", data::habit, false, bodies},
      {"arrangement", "leaf", "", data::arrangement, false, {}, {"vein", "ovary", "thorn", "hair", "seta", "gland", "lenticel", "scale", "pappus", "bark"}},
      {"type", "leaf", "", data::leaf_type, false, {"leaf", "plant"}},
      {"shape", "leaf", "", data::leaf_shape, false, {}, {"stem", "trunk", "branch", "internode", "petiole", "petiolule", "peduncle", "pedicel", "rachis"}},
      {"apex", "leaf", "apex", data::apex},
      {"base", "leaf", "base", data::base},
      {"margin", "leaf", "margin", data::margin, false, {}, {"vein", "stem", "branch", "trunk", "thorn", "rachis", "petiole", "petiolule", "pedicel", "peduncle", "rhizome", "root", "bark", "disk"}},
      {"attachment", "leaf", "", data::attachment},
      {"venation", "leaf", "", data::venation, false, {}, {"pappus", "awn", "stigma", "style", "hair", "seta", "coma"}},
      {"surface", "leaf", "surface", data::surface},
      {"life form", "plant", "", data::life_form, true},
      {"duration", "plant", "", data::duration},
      {"branching", "stem", "", data::branching, false, {"stem", "branch", "plant", "tendril", "inflorescence", "root", "style", "trunk", "rhizome", "thorn"}},
      {"orientation", "leaf", "", data::orientation, false, {}, {"plant", "stem", "trunk", "rhizome"}},
      {"section", "stem", "", data::stem_section},
      {"position", "inflorescence", "", data::position, false,
       {"inflorescence", "flower", "ovary", "stamen", "style", "anther", "spikelet", "bud", "flower bud", "tendril", "peduncle", "fruit", "stigma"}},
      {"type", "inflorescence", "", data::inflorescence_type, true},
      {"form", "flower", "", data::flower_plan, false, {"flower", "corolla", "calyx", "perianth", "involucre", "petal", "hypanthium", "plant", "inflorescence", "corona", "ray floret"}},
      {"type", "fruit", "", data::fruit_type, true},
      {"opening", "fruit", "", data::opening, false, {"fruit", "anther", "bark"}},
      {"colour", "flower", "", data::colour},
  };
}

std::vector<Term> termsIn(const std::string& cell) {
  std::vector<Term> terms;
  if (cell == "-") return terms;
  for (std::string& words : splitList(cell, ',')) {
    const bool everyday = words.ends_with('?');
    if (everyday) words.pop_back();
    terms.push_back({std::move(words), everyday});
  }
  return terms;
}

Concept conceptOf(const Table& table, const Table::Row& row) {
  Concept entry;
  entry.name = table.cell(row, "concept");
  entry.english = termsIn(table.cell(row, "english"));
  entry.traditional = termsIn(table.cell(row, "traditional"));
  entry.simplified = termsIn(table.cell(row, "simplified"));
  entry.definition = table.cell(row, "definition");
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (row.cells[i] != "-") entry.columns[table.columns[i]] = row.cells[i];
  return entry;
}

std::vector<Category> readVocabulary() {
  std::vector<Category> categories;
  for (const Source& source : sources()) {
    const Result<Table> table = readTable(source.table, source.property);
    AXIL_ASSERT(table.has_value(), "a vocabulary table has rows of unequal length");
    Category category{std::string(source.property), std::string(source.defaultOrgan), std::string(source.part), source.ownOrgan, source.organs,
                      source.notOrgans, {}};
    for (const Table::Row& row : table->rows) category.concepts.push_back(conceptOf(*table, row));
    categories.push_back(std::move(category));
  }
  return categories;
}

}  // namespace

const std::vector<Category>& vocabulary() {
  static const std::vector<Category> categories = readVocabulary();
  return categories;
}

const Category& categoryOf(std::string_view property) {
  const auto found = std::find_if(vocabulary().begin(), vocabulary().end(), [&](const Category& c) { return c.property == property; });
  AXIL_ASSERT(found != vocabulary().end(), "the vocabulary is asked for a category that it does not have");
  return *found;
}

}  // namespace axil::keywords
