#include "simeco/report.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace axil::simeco {

namespace {

std::string countOfMore(std::size_t errors, std::size_t warnings) {
  const auto words = [](std::size_t n, const char* one) { return std::to_string(n) + " more " + one + (n == 1 ? "" : "s"); };
  if (warnings == 0) return words(errors, "error") + " not shown";
  if (errors == 0) return words(warnings, "warning") + " not shown";
  return words(errors, "error") + " and " + words(warnings, "warning") + " not shown";
}

Diagnostic moreLine(SourceSpan at, std::size_t errors, std::size_t warnings) {
  return {errors > 0 ? Severity::Error : Severity::Warning, at, countOfMore(errors, warnings), "mend the ones above first"};
}

void sortByPlace(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.span.begin < b.span.begin; });
}

}  // namespace

void Report::error(SourceSpan span, std::string message, std::string hint) {
  add({Severity::Error, span, std::move(message), std::move(hint)});
}

void Report::warning(SourceSpan span, std::string message, std::string hint) {
  add({Severity::Warning, span, std::move(message), std::move(hint)});
}

// Errors push warnings out, never the other way round: a file with an error must always show one.
void Report::add(Diagnostic diagnostic) {
  const bool isError = diagnostic.severity == Severity::Error;
  // A parser that looks at a place a second time finds the same thing there.
  const std::size_t look = std::min<std::size_t>(kept_.size(), 4);
  if (std::find(kept_.end() - static_cast<std::ptrdiff_t>(look), kept_.end(), diagnostic) != kept_.end()) return;
  if (kept_.size() < kMostDiagnostics) {
    warnings_ += isError ? 0 : 1;
    kept_.push_back(std::move(diagnostic));
  } else if (isError && warnings_ > 0) {
    const auto last = std::find_if(kept_.rbegin(), kept_.rend(), [](const Diagnostic& d) { return d.severity == Severity::Warning; });
    *last = std::move(diagnostic);
    --warnings_;
    ++warningsLeftOut_;
  } else {
    ++(isError ? errorsLeftOut_ : warningsLeftOut_);
  }
}

std::vector<Diagnostic> Report::take() {
  sortByPlace(kept_);
  if (errorsLeftOut_ + warningsLeftOut_ > 0) kept_.push_back(moreLine(kept_.back().span, errorsLeftOut_, warningsLeftOut_));
  return std::exchange(kept_, {});
}

std::vector<Diagnostic> limited(std::vector<Diagnostic> diagnostics) {
  Report report;
  for (Diagnostic& d : diagnostics)
    d.severity == Severity::Error ? report.error(d.span, std::move(d.message), std::move(d.hint))
                                  : report.warning(d.span, std::move(d.message), std::move(d.hint));
  return report.take();
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
  const auto lower = [](std::string_view text) {
    std::string small(text);
    for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return small;
  };
  constexpr std::size_t kLongestWord = 64;  // nothing we know is longer; the distance costs length squared
  if (word.empty() || word.size() > kLongestWord) return {};
  const std::string small = lower(word);
  std::string_view best;
  std::size_t bestDistance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string_view candidate : known) {
    const std::size_t distance = editDistance(small, lower(candidate));
    if (distance < bestDistance) best = candidate, bestDistance = distance;
  }
  // A one-letter name is one edit from every other one: only its other case is a likely slip.
  return word.size() <= 2 && bestDistance > 0 ? std::string_view{} : best;
}

std::string didYouMean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view best = nearest(word, known);
  return best.empty() ? std::string{} : "did you mean '" + std::string(best) + "'?";
}

}  // namespace axil::simeco
