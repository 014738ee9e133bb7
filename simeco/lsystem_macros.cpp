#include "simeco/lsystem_macros.hpp"

#include "simeco/lsystem_scan.hpp"

namespace axil::simeco::preprocess {

namespace {

constexpr int kMacroDepth = 64;
constexpr int kConditionDepth = 64;

/// Replaces macros in a text that has no places any more: a macro's body or argument.
class Expander {
 public:
  Expander(const Macros& macros, std::size_t limit) : macros_(macros), limit_(limit) {}

  std::string expand(std::string_view text) {
    if (++depth_ > kMacroDepth) {
      problem_ = "macros are nested more than " + std::to_string(kMacroDepth) + " deep here";
      --depth_;
      return {};
    }
    std::string out;
    for (std::size_t i = 0; i < text.size() && problem_.empty();) i = token(text, i, out);
    --depth_;
    return out;
  }

  /// What the use of macro `name` stands for, with `arguments` as written.
  std::string use(const std::string& name, const Macro& macro, const std::vector<std::string>& arguments) {
    if (!macro.takesArguments) return body(name, macro.body);
    if (!argumentsFit(name, macro, arguments)) return {};
    std::map<std::string, std::string, std::less<>> values;
    for (std::size_t i = 0; i < macro.parameters.size(); ++i) values[macro.parameters[i]] = expand(arguments[i]);
    return body(name, withArguments(macro.body, values));
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  std::size_t token(std::string_view text, std::size_t at, std::string& out) {
    const char c = text[at];
    if (c == '"')
      if (const auto end = quotedEnd(text, at)) return keep(text, at, *end, out);
    if (isDigit(c) || (c == '.' && at + 1 < text.size() && isDigit(text[at + 1]))) return keep(text, at, numberEnd(text, at), out);
    if (!isNameStart(c)) return keep(text, at, at + 1, out);
    const std::string name(nameAt(text, at));
    const std::size_t after = at + name.size();
    const auto macro = macros_.find(name);
    if (macro == macros_.end() || active_.contains(name)) return keep(text, at, after, out);
    if (!macro->second.takesArguments) {
      add(out, use(name, macro->second, {}));
      return after;
    }
    const std::size_t open = skipBlanks(text, after);
    if (open >= text.size() || text[open] != '(') return keep(text, at, after, out);
    const auto arguments = argumentsAt(text, open);
    if (!arguments) {
      problem_ = "the use of macro " + name + " is not closed";
      return text.size();
    }
    add(out, use(name, macro->second, arguments->values));
    return arguments->end;
  }

  std::size_t keep(std::string_view text, std::size_t begin, std::size_t end, std::string& out) {
    out.append(text.substr(begin, end - begin));
    return end;
  }

  void add(std::string& out, const std::string& more) {
    // Blanks keep the replaced text from growing together with its neighbours.
    out.append(" ").append(more).append(" ");
    made_ += more.size() + 2;
    if (made_ > limit_) problem_ = "macros make more than " + std::to_string(limit_) + " bytes of text";
  }

  std::string body(const std::string& name, std::string_view text) {
    active_.insert(name);
    std::string result = expand(text);
    active_.erase(name);
    return result;
  }

  bool argumentsFit(const std::string& name, const Macro& macro, const std::vector<std::string>& arguments) {
    const bool none = macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty();
    if (none || arguments.size() == macro.parameters.size()) return true;
    problem_ = "macro " + name + " takes " + std::to_string(macro.parameters.size()) + " arguments, not " + std::to_string(arguments.size());
    return false;
  }

  static std::string withArguments(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      std::size_t end = i + 1;
      if (isNameStart(text[i])) end = i + nameAt(text, i).size();
      else if (isDigit(text[i])) end = numberEnd(text, i);
      const std::string_view word = text.substr(i, end - i);
      const auto value = values.find(word);
      out.append(value == values.end() ? word : std::string_view(value->second));
      i = end;
    }
    return out;
  }

  const Macros& macros_;
  std::size_t limit_;
  std::size_t made_ = 0;
  int depth_ = 0;
  std::set<std::string, std::less<>> active_;
  std::string problem_;
};

/// The value of an `#if` line: whole numbers, C's operators, names that are no macros count as 0.
class ConditionReader {
 public:
  explicit ConditionReader(std::string_view text) : text_(text) {}

  std::optional<std::int64_t> value() {
    const std::int64_t result = choice();
    skip();
    if (at_ != text_.size()) bad_ = true;
    return bad_ ? std::nullopt : std::optional(result);
  }

 private:
  struct Operator {
    std::string_view text;
    int level;
  };

  void skip() { at_ = skipBlanks(text_, at_); }
  bool eat(std::string_view token) {
    skip();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  std::int64_t choice() {
    const std::int64_t condition = binary(0);
    if (!eat("?")) return condition;
    const std::int64_t yes = choice();
    if (!eat(":")) bad_ = true;
    const std::int64_t no = choice();
    return condition != 0 ? yes : no;
  }

  std::optional<Operator> operatorAbove(int level) {
    static constexpr Operator kOperators[] = {{"||", 0}, {"&&", 1}, {"==", 2}, {"!=", 2}, {"<=", 3}, {">=", 3}, {"<", 3},
                                              {">", 3},  {"+", 4},  {"-", 4},  {"*", 5},  {"/", 5},  {"%", 5}};
    skip();
    for (const Operator& op : kOperators)
      if (text_.substr(at_).starts_with(op.text)) return op.level >= level ? std::optional(op) : std::nullopt;
    return std::nullopt;
  }

  std::int64_t binary(int level) {
    std::int64_t left = unary();
    while (!bad_) {
      const auto op = operatorAbove(level);
      if (!op) break;
      at_ += op->text.size();
      left = applied(op->text, left, binary(op->level + 1));
    }
    return left;
  }

  std::int64_t applied(std::string_view op, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<std::uint64_t>(a);
    const auto ub = static_cast<std::uint64_t>(b);
    if (op == "||") return a != 0 || b != 0;
    if (op == "&&") return a != 0 && b != 0;
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<=") return a <= b;
    if (op == ">=") return a >= b;
    if (op == "<") return a < b;
    if (op == ">") return a > b;
    if (op == "+") return static_cast<std::int64_t>(ua + ub);
    if (op == "-") return static_cast<std::int64_t>(ua - ub);
    if (op == "*") return static_cast<std::int64_t>(ua * ub);
    if (b == 0 || (b == -1)) {
      if (b == 0) bad_ = true;
      return op == "%" ? 0 : static_cast<std::int64_t>(0 - ua);
    }
    return op == "/" ? a / b : a % b;
  }

  std::int64_t unary() {
    if (++depth_ > kConditionDepth) {
      bad_ = true;
      return 0;
    }
    std::int64_t result = 0;
    if (eat("!")) result = unary() == 0;
    else if (eat("-")) result = static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(unary()));
    else if (eat("+")) result = unary();
    else result = primary();
    --depth_;
    return result;
  }

  std::int64_t primary() {
    if (eat("(")) {
      const std::int64_t inner = choice();
      if (!eat(")")) bad_ = true;
      return inner;
    }
    skip();
    if (const std::string_view name = nameAt(text_, at_); !name.empty()) {
      at_ += name.size();
      return 0;
    }
    if (at_ >= text_.size() || !isDigit(text_[at_])) {
      bad_ = true;
      return 0;
    }
    std::uint64_t number = 0;
    while (at_ < text_.size() && isDigit(text_[at_])) number = number * 10 + static_cast<std::uint64_t>(text_[at_++] - '0');
    if (at_ < text_.size() && (isNamePart(text_[at_]) || text_[at_] == '.')) bad_ = true;
    return static_cast<std::int64_t>(number);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool bad_ = false;
};

}  // namespace

std::optional<MacroArguments> argumentsAt(std::string_view text, std::size_t open) {
  MacroArguments found;
  std::string value;
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' && depth++ == 0) continue;
    if (c == ')' && --depth == 0) {
      found.values.emplace_back(trimmed(value));
      found.end = i + 1;
      return found;
    }
    if (c == ',' && depth == 1) {
      found.values.emplace_back(trimmed(value));
      value.clear();
    } else {
      value.push_back(c == '\n' ? ' ' : c);
    }
  }
  return std::nullopt;
}

Expanded expanded(const Macros& macros, std::size_t limit, std::string_view text) {
  Expander expander(macros, limit);
  std::string result = expander.expand(text);
  return {std::move(result), expander.problem()};
}

Expanded usedMacro(const Macros& macros, std::size_t limit, const std::string& name, const Macro& macro, const std::vector<std::string>& arguments) {
  Expander expander(macros, limit);
  std::string result = expander.use(name, macro, arguments);
  return {std::move(result), expander.problem()};
}

std::optional<std::int64_t> conditionValue(std::string_view text) { return ConditionReader(text).value(); }

}  // namespace axil::simeco::preprocess
