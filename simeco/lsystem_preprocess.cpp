#include "simeco/lsystem_preprocess.hpp"

#include "simeco/lsystem_clean.hpp"
#include "simeco/lsystem_macros.hpp"
#include "simeco/lsystem_scan.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace axil::simeco {

using namespace preprocess;

namespace {

constexpr int kIncludeDepth = 16;

}  // namespace

const Preprocessed::Piece& Preprocessed::pieceAt(std::size_t offset) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), offset, [](std::size_t at, const Piece& p) { return at < p.at; });
  return after == pieces_.begin() ? pieces_.front() : *std::prev(after);
}

SourceSpan Preprocessed::originOf(std::size_t begin, std::size_t end) const {
  begin = std::min(begin, text.size());
  end = std::clamp(end, begin, text.size());
  const Piece& first = pieceAt(begin);
  if (first.file != 0) return files_[static_cast<std::size_t>(first.file)].includedAt;
  SourceSpan span = first.origin;
  if (first.verbatim) span.begin += static_cast<std::uint32_t>(begin - first.at);
  span.end = std::max(first.verbatim ? span.begin : span.end, span.begin);
  if (end <= begin) return first.verbatim ? span : SourceSpan{span.begin, span.end};
  const Piece& last = pieceAt(end - 1);
  if (last.file != 0) return span;
  const std::uint32_t lastEnd = last.verbatim ? last.origin.begin + static_cast<std::uint32_t>(end - last.at) : last.origin.end;
  span.end = std::max(span.begin, lastEnd);
  return span;
}

Diagnostic Preprocessed::diagnostic(Severity severity, std::size_t begin, std::size_t end, std::string message, std::string hint) const {
  const Piece& piece = pieceAt(begin);
  const File& file = files_[static_cast<std::size_t>(piece.file)];
  if (piece.file != 0) {
    const auto offset = static_cast<std::uint32_t>(piece.origin.begin + (piece.verbatim ? begin - piece.at : 0));
    message = "in " + file.name + ", line " + std::to_string(placeOf(file.text, offset).line) + ": " + message;
  }
  if (!piece.verbatim) hint += (hint.empty() ? "the macro here stands for '" : "; the macro here stands for '") + madeBy(piece) + "'";
  return {severity, originOf(begin, end), std::move(message), std::move(hint)};
}

std::string Preprocessed::madeBy(const Piece& piece) const {
  constexpr std::size_t most = 60;
  const Piece* next = &piece + 1;
  const std::size_t end = next < pieces_.data() + pieces_.size() ? next->at : text.size();
  const std::string_view made = trimmed(std::string_view(text).substr(piece.at, end - piece.at));
  return made.size() > most ? std::string(made.substr(0, most)) + "..." : std::string(made);
}

/// Runs over the outermost text and, from there, over what it includes.
class Preprocessor {
 public:
  Preprocessor(std::string_view text, const LSystemOptions& options) : options_(options), limit_(text.size() + options.macroTextLimit) {
    result_.files_.push_back({});
    result_.text.reserve(text.size());
  }

  Preprocessed run(std::string_view text) {
    process(text, 0);
    // So that the end of the text has a place, too.
    result_.pieces_.push_back({result_.text.size(), spanOf(text.size(), text.size()), true, 0});
    joinTabbedLines();
    return std::move(result_);
  }

 private:
  /// The state of one #if: whether its lines count, and whether one of its branches has counted already.
  struct Branch {
    bool counts = true;
    bool done = true;
    bool elseSeen = false;
    SourceSpan where;
  };

  void process(std::string_view text, std::int32_t file) {
    const std::int32_t outerFile = std::exchange(file_, file);
    const Clean clean = cleaned(text);
    const std::size_t outerBranches = branches_.size();
    std::size_t comment = 0;
    for (std::size_t at = 0; at < clean.text.size() && !full_;) at = line(clean, at, comment);
    takeComments(clean, comment, clean.text.size(), 0);
    result_.cutShort = result_.cutShort || clean.openComment || branches_.size() > outerBranches;
    if (clean.openComment) error(*clean.openComment, "this comment is never closed", "end it with */");
    while (branches_.size() > outerBranches) {
      error(branches_.back().where, "this #if has no #endif", "add a line #endif");
      branches_.pop_back();
    }
    file_ = outerFile;
  }

  std::size_t line(const Clean& clean, std::size_t begin, std::size_t& comment) {
    std::size_t end = std::min(clean.text.find('\n', begin), clean.text.size());
    const std::size_t next = std::min(end + 1, clean.text.size());
    const std::string_view words = std::string_view(clean.text).substr(begin, end - begin);
    const std::size_t hash = skipBlanks(words, 0);
    if (isDirective(words, hash)) {
      takeComments(clean, comment, next, result_.text.size());
      directive(words.substr(hash + 1), SourceSpan(spanOf(clean.originOf(begin + hash), clean.originOf(end))));
      return next;
    }
    if (!counting()) {
      while (comment < clean.comments.size() && clean.comments[comment].at < next) ++comment;
      return next;
    }
    return copyLine(clean, begin, next, comment);
  }

  static bool isDirective(std::string_view words, std::size_t hash) {
    if (hash >= words.size() || words[hash] != '#') return false;
    if (hash == 0) return true;
    static const std::set<std::string_view> kNames{"define", "undef", "include", "if", "ifdef", "ifndef", "elif", "else", "endif", "pragma", "error", "warning"};
    return kNames.contains(nameAt(words, skipBlanks(words, hash + 1)));
  }

  std::size_t copyLine(const Clean& clean, std::size_t begin, std::size_t end, std::size_t& comment) {
    const std::string_view text = clean.text;
    std::size_t done = begin;
    std::size_t at = begin;
    while (at < end && !full_) {
      const char c = text[at];
      if (c == '"') {
        const auto close = quotedEnd(text, at);
        at = close ? *close : at + 1;
      } else if (isDigit(c) || (c == '.' && at + 1 < end && isDigit(text[at + 1]))) {
        at = numberEnd(text, at);
      } else if (!isNameStart(c)) {
        ++at;
      } else {
        const std::string_view name = nameAt(text, at);
        const auto macro = macros_.find(name);
        const std::size_t after = at + name.size();
        const std::size_t open = skipBlanks(text, after);
        const bool used = macro != macros_.end() && (!macro->second.takesArguments || (open < text.size() && text[open] == '('));
        if (used) {
          copy(clean, done, at, comment);
          at = done = expandAt(clean, at, macro->first, macro->second, open);
          if (at > end) end = std::min(text.find('\n', at) == std::string_view::npos ? text.size() : text.find('\n', at) + 1, text.size());
        } else {
          at = after;
        }
      }
    }
    copy(clean, done, end, comment);
    return end;
  }

  std::size_t expandAt(const Clean& clean, std::size_t at, const std::string& name, const Macro& macro, std::size_t open) {
    std::size_t end = at + name.size();
    std::vector<std::string> arguments;
    if (macro.takesArguments) {
      auto found = argumentsAt(clean.text, open);
      if (!found) {
        error(spanOf(clean.originOf(at), clean.originOf(end)), "the use of macro " + name + " is not closed", "add the missing )");
        return end;
      }
      arguments = std::move(found->values);
      end = found->end;
    }
    const SourceSpan where = spanOf(clean.originOf(at), clean.originOf(end));
    const Expanded used = usedMacro(macros_, limit_, name, macro, arguments);
    const std::string made = " " + used.text + " ";
    if (!used.problem.empty()) error(where, used.problem, {});
    if (result_.text.size() + made.size() > limit_) {
      error(where, "macros and includes make more than " + std::to_string(options_.macroTextLimit) + " bytes of text", {});
      full_ = true;
      return end;
    }
    result_.pieces_.push_back({result_.text.size(), where, false, file_});
    result_.text += made;
    return end;
  }

  void copy(const Clean& clean, std::size_t begin, std::size_t end, std::size_t& comment) {
    if (begin >= end) return;
    takeComments(clean, comment, end, result_.text.size() - begin);
    if (result_.text.size() + (end - begin) > limit_) {
      error(spanOf(clean.originOf(begin), clean.originOf(end)), "macros and includes make more than " + std::to_string(options_.macroTextLimit) + " bytes of text", {});
      full_ = true;
      return;
    }
    // Each stretch between two removed things is a piece of its own.
    auto move = std::upper_bound(clean.moves.begin(), clean.moves.end(), std::pair{begin, static_cast<std::size_t>(-1)});
    for (std::size_t from = begin; from < end;) {
      const std::size_t to = move == clean.moves.end() ? end : std::min(end, move->first);
      if (to > from) addPiece(clean.originOf(from));
      result_.text.append(clean.text, from, to - from);
      from = to;
      if (move != clean.moves.end()) ++move;
    }
  }

  void addPiece(std::size_t origin) {
    if (!result_.pieces_.empty()) {
      const auto& last = result_.pieces_.back();
      if (last.verbatim && last.file == file_ && last.origin.begin + (result_.text.size() - last.at) == origin) return;
    }
    result_.pieces_.push_back({result_.text.size(), spanOf(origin, origin), true, file_});
  }

  /// Comments before byte `end` of the clean text; `shift` (modulo the word) leads to their place in the result.
  void takeComments(const Clean& clean, std::size_t& comment, std::size_t end, std::size_t shift) {
    for (; comment < clean.comments.size() && clean.comments[comment].at < end; ++comment) {
      PlacedComment placed = clean.comments[comment];
      placed.at = std::min(placed.at + shift, result_.text.size() + (end - placed.at));
      result_.comments.push_back(std::move(placed));
    }
    if (end == clean.text.size())
      for (; comment < clean.comments.size(); ++comment) {
        PlacedComment placed = clean.comments[comment];
        placed.at = result_.text.size();
        result_.comments.push_back(std::move(placed));
      }
  }

  void directive(std::string_view words, SourceSpan where) {
    const std::size_t at = skipBlanks(words, 0);
    const std::string_view name = nameAt(words, at);
    const std::string_view rest = trimmed(words.substr(at + name.size()));
    if (name == "if" || name == "ifdef" || name == "ifndef") return openBranch(name, rest, where);
    if (name == "elif" || name == "else") return nextBranch(name, rest, where);
    if (name == "endif") return closeBranch(where);
    if (!counting()) return;
    if (name == "define") return define(rest, where);
    if (name == "undef") return undefine(rest);
    if (name == "include") return include(rest, where);
    if (name == "error") return error(where, "#error " + std::string(rest), {});
    if (name == "pragma" || name == "warning" || (name.empty() && rest.empty())) return;
    const bool filter = name == "ignore" || name == "consider";
    error(where, "a line that starts with # is a directive, and this is none of define, undef, include, if, ifdef, ifndef, elif, else, endif",
          filter ? "write " + std::string(name) + ": and the letters, without #, before Axiom:" : "a comment starts with //; to begin a rule with the letter #, write * < # --> ...");
  }

  [[nodiscard]] bool counting() const { return branches_.empty() || branches_.back().counts; }

  void openBranch(std::string_view name, std::string_view rest, SourceSpan where) {
    const bool outer = counting();
    bool holds = false;
    if (outer) holds = name == "if" ? conditionOf(rest, where) : macros_.contains(nameAt(rest, 0)) == (name == "ifdef");
    if (outer && name != "if" && nameAt(rest, 0).empty()) error(where, "#" + std::string(name) + " needs the name of a macro", {});
    branches_.push_back({outer && holds, !outer || holds, false, where});
  }

  void nextBranch(std::string_view name, std::string_view rest, SourceSpan where) {
    if (branches_.empty() || branches_.back().elseSeen) return error(where, "#" + std::string(name) + " without #if", {});
    Branch& branch = branches_.back();
    branch.elseSeen = name == "else";
    branch.counts = !branch.done && (name == "else" || conditionOf(rest, where));
    branch.done = branch.done || branch.counts;
  }

  void closeBranch(SourceSpan where) {
    if (branches_.empty()) return error(where, "#endif without #if", {});
    branches_.pop_back();
  }

  bool conditionOf(std::string_view text, SourceSpan where) {
    const Expanded condition = expanded(macros_, limit_, withDefinedReplaced(text));
    const auto value = condition.problem.empty() ? conditionValue(condition.text) : std::nullopt;
    if (!value) error(where, "this #if is not a whole-number condition", {});
    return value.value_or(0) != 0;
  }

  /// `defined X` and `defined(X)` as 1 or 0, before X is replaced.
  [[nodiscard]] std::string withDefinedReplaced(std::string_view text) const {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      const std::string_view name = nameAt(text, i);
      if (name != "defined") {
        const std::size_t count = std::max<std::size_t>(name.size(), 1);
        out.append(text.substr(i, count));
        i += count;
        continue;
      }
      i = skipBlanks(text, i + name.size());
      const bool inside = i < text.size() && text[i] == '(';
      if (inside) i = skipBlanks(text, i + 1);
      const std::string_view asked = nameAt(text, i);
      i = skipBlanks(text, i + asked.size());
      if (inside && i < text.size() && text[i] == ')') ++i;
      out.append(macros_.contains(asked) ? " 1 " : " 0 ");
    }
    return out;
  }

  void define(std::string_view rest, SourceSpan where) {
    const std::string name(nameAt(rest, 0));
    if (name.empty()) return error(where, "#define needs the name of a macro", "a name starts with a letter");
    Macro macro;
    std::string_view body = rest.substr(name.size());
    if (!body.empty() && body[0] == '(') {
      const std::size_t close = body.find(')');
      if (close == std::string_view::npos) return error(where, "the parameters of macro " + name + " are not closed", "add the missing )");
      macro.takesArguments = true;
      if (!parametersOf(body.substr(1, close - 1), macro.parameters)) return error(where, "a parameter of macro " + name + " is not a name", {});
      body.remove_prefix(close + 1);
    }
    macro.body = trimmed(body);
    const auto old = macros_.find(name);
    if (old != macros_.end() && old->second.body != macro.body)
      result_.diagnostics.push_back(placed(Severity::Warning, where, "macro " + name + " is defined again, differently", "#undef it first"));
    macros_.insert_or_assign(name, std::move(macro));
  }

  static bool parametersOf(std::string_view list, std::vector<std::string>& names) {
    if (trimmed(list).empty()) return true;
    while (true) {
      const std::size_t comma = std::min(list.find(','), list.size());
      const std::string_view name = trimmed(list.substr(0, comma));
      if (name.empty() || nameAt(name, 0).size() != name.size()) return false;
      names.emplace_back(name);
      if (comma == list.size()) return true;
      list.remove_prefix(comma + 1);
    }
  }

  void undefine(std::string_view rest) {
    const auto macro = macros_.find(nameAt(rest, 0));
    if (macro != macros_.end()) macros_.erase(macro);
  }

  void include(std::string_view rest, SourceSpan where) {
    const bool quoted = rest.size() > 2 && rest.front() == '"' && rest.back() == '"';
    if (!quoted) return error(where, "#include needs a file name in quotes", "#include \"name\"");
    const std::string name(rest.substr(1, rest.size() - 2));
    if (!options_.include) return error(where, "this text cannot include " + name, "read the grammar from a file, so that its folder is known");
    if (includeDepth_ >= kIncludeDepth) return error(where, "includes are nested more than " + std::to_string(kIncludeDepth) + " deep", "does a file include itself?");
    Result<std::string> text = options_.include(name);
    if (!text) return error(where, text.error().message, {});
    const SourceSpan outermost = file_ == 0 ? where : result_.files_[static_cast<std::size_t>(file_)].includedAt;
    result_.files_.push_back({name, *text, outermost});
    ++includeDepth_;
    process(*text, static_cast<std::int32_t>(result_.files_.size()) - 1);
    --includeDepth_;
    if (!result_.text.empty() && result_.text.back() != '\n') result_.text.push_back('\n');
  }

  Diagnostic placed(Severity severity, SourceSpan where, std::string message, std::string hint) const {
    const auto& file = result_.files_[static_cast<std::size_t>(file_)];
    if (file_ == 0) return {severity, where, std::move(message), std::move(hint)};
    message = "in " + file.name + ", line " + std::to_string(placeOf(file.text, where.begin).line) + ": " + message;
    return {severity, file.includedAt, std::move(message), std::move(hint)};
  }

  void error(SourceSpan where, std::string message, std::string hint) {
    result_.diagnostics.push_back(placed(Severity::Error, where, std::move(message), std::move(hint)));
  }

  void joinTabbedLines() {
    std::string& text = result_.text;
    for (std::size_t i = text.find("\n\t"); i != std::string::npos; i = text.find("\n\t", i + 1)) text[i] = ' ';
  }

  const LSystemOptions& options_;
  std::size_t limit_;
  Macros macros_;
  std::vector<Branch> branches_;
  Preprocessed result_;
  std::int32_t file_ = 0;
  int includeDepth_ = 0;
  bool full_ = false;
};

Preprocessed preprocessLSystem(std::string_view text, const LSystemOptions& options) { return Preprocessor(text, options).run(text); }

}  // namespace axil::simeco
