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

/// Every byte is a character of its own.
std::string fromLatin1(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0u | (byte >> 6u));
      text += static_cast<char>(0x80u | (byte & 0x3fu));
    }
  }
  return text;
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

}  // namespace

void addChecked(Parsed& parsed) {
  // An empty text has nothing to check; what is wrong with it was said.
  if (parsed.grammar.plants.empty() && !parsed.ok()) return;
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

Result<std::string> decodeGrammarText(std::string_view bytes, Language language) {
  if (auto decoded = decodeText(bytes)) return std::move(decoded->utf8);
  if (language == Language::LSystem && bytes.find('\0') == std::string_view::npos) return fromLatin1(bytes);
  return fail(ErrorCode::Unreadable, "this is not a text: it is neither UTF-8 nor Big5; save it as UTF-8");
}

Result<GrammarFile> readGrammarFile(const std::filesystem::path& path) {
  auto bytes = readFile(path, kMostBytes);
  if (!bytes) return bytes.failure();
  auto decoded = decodeGrammarText(*bytes, path.extension() == ".l" ? Language::LSystem : Language::SimEco);
  if (!decoded) return fail(ErrorCode::Unreadable, "'" + path.string() + "': " + decoded.error().message);
  GrammarFile file{path, *std::move(decoded), {}};
  file.parsed = parseAs(path, file.text);
  file.parsed.grammar.source.file = path.filename().string();
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
