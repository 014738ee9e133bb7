#include "base/files.hpp"

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

namespace axil::simeco {

namespace {

Parsed parseAs(const std::filesystem::path& path, std::string_view text) {
  if (path.extension() != ".l") return parseSimeco(text);
  LSystemOptions options;
  options.include = includesBeside(path);
  return parseLSystem(text, options);
}

bool isInside(SourceSpan outer, SourceSpan inner) { return outer.begin <= inner.begin && inner.begin < outer.end; }

/// Rules that did not parse. What checking finds in one is mostly the same mistake once more.
std::vector<SourceSpan> brokenRules(const Parsed& parsed) {
  std::vector<SourceSpan> broken;
  for (const PlantGrammar& plant : parsed.grammar.plants)
    for (const Production& p : plant.rules.productions)
      if (std::any_of(parsed.diagnostics.begin(), parsed.diagnostics.end(), [&](const Diagnostic& d) { return isInside(p.where, d.span); }))
        broken.push_back(p.where);
  return broken;
}

void addChecked(Parsed& parsed) {
  const std::vector<SourceSpan> broken = parsed.diagnostics.empty() ? std::vector<SourceSpan>{} : brokenRules(parsed);
  std::vector<Diagnostic> found = check(parsed.grammar);
  std::erase_if(found, [&](const Diagnostic& d) {
    return std::any_of(broken.begin(), broken.end(), [&](SourceSpan rule) { return isInside(rule, d.span); });
  });
  // Where the text is broken, what seems unused or missing may stand in what could not be read.
  if (!parsed.ok()) std::erase_if(found, [](const Diagnostic& d) { return d.severity == Severity::Warning; });
  std::move(found.begin(), found.end(), std::back_inserter(parsed.diagnostics));
  parsed.diagnostics = limited(std::move(parsed.diagnostics));
}

}  // namespace

Result<GrammarFile> readGrammarFile(const std::filesystem::path& path) {
  auto bytes = readFile(path, kMostBytes);
  if (!bytes) return bytes.failure();
  auto decoded = decodeText(*bytes);
  if (!decoded) return fail(ErrorCode::Unreadable, "'" + path.string() + "' is not a text: it is neither UTF-8 nor Big5; save it as UTF-8");
  GrammarFile file{path, std::move(decoded->utf8), {}};
  file.parsed = parseAs(path, file.text);
  // An empty text has nothing to check; what is wrong with it was said.
  if (!file.parsed.grammar.plants.empty() || file.parsed.ok()) addChecked(file.parsed);
  return file;
}

Result<Grammar> loadGrammar(const std::filesystem::path& path) {
  auto file = readGrammarFile(path);
  if (!file) return file.failure();
  if (file->parsed.ok()) return std::move(file->parsed.grammar);
  Error error{ErrorCode::BadGrammar, "'" + path.string() + "' has errors; mend what is listed", {}};
  for (const Diagnostic& d : file->parsed.diagnostics) error.details.push_back(formatDiagnostic(d, file->text, path.string()));
  return fail(std::move(error));
}

}  // namespace axil::simeco
