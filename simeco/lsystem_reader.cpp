#include "simeco/lsystem_reader.hpp"

#include "base/text.hpp"
#include "simeco/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace axil::simeco {

namespace {

constexpr int kNesting = 200;      // of brackets, blocks and expression trees, as Limits::expressionDepth
constexpr std::size_t kParameters = 20;

constexpr LSystemFunction kFunctions[] = {
    {"sin"}, {"cos"}, {"tan"}, {"asin"}, {"acos"}, {"atan"}, {"atan2", 2, 2}, {"exp"}, {"log"}, {"sqrt"}, {"fabs"},
    {"floor"}, {"ceil"}, {"sign"}, {"trunc"},
    {"ran"}, {"nran", 2, 2}, {"bran", 2, 2}, {"biran", 2, 2}, {"srand"},
    {"func", 1, kManyArguments}, {"com", 1, kManyArguments}, {"curveX", 2, 2}, {"curveY", 2, 2}, {"curveZ", 2, 2}, {"curveGAL"},
    {"printf", 1, kManyArguments, true}, {"fprintf", 2, kManyArguments, true}, {"fscanf", 2, kManyArguments, true},
    {"fopen", 2, 2, true}, {"fclose"}, {"fflush"}, {"play", 1, 1, true},
    {"stop"}, {"Display"}, {"SetDerivationLength"}, {"GetDerivationLength"}, {"inblob", 4, 4},
    {"vvXmin"}, {"vvXmax"}, {"vvYmin"}, {"vvYmax"}, {"vvZmin"}, {"vvZmax"}, {"vvScale"},
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isNamePart(char c) { return isNameStart(c) || isDigit(c) || c == '_'; }
bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\f' || c == '\v' || c == '\r'; }

struct OperatorRow {
  std::string_view text;
  BinaryOp op;
};
// Loosest first; within a level the longer text first, so that <= is not read as <.
constexpr OperatorRow kOr[] = {{"||", BinaryOp::Or}};
constexpr OperatorRow kAnd[] = {{"&&", BinaryOp::And}};
constexpr OperatorRow kEquality[] = {{"==", BinaryOp::Equal}, {"!=", BinaryOp::NotEqual}, {"<>", BinaryOp::NotEqual}};
constexpr OperatorRow kRelation[] = {{"<=", BinaryOp::LessEqual}, {">=", BinaryOp::GreaterEqual}, {"<", BinaryOp::Less}, {">", BinaryOp::Greater}};
constexpr OperatorRow kSum[] = {{"+", BinaryOp::Add}, {"-", BinaryOp::Subtract}};
constexpr OperatorRow kProduct[] = {{"*", BinaryOp::Multiply}, {"/", BinaryOp::Divide}, {"%", BinaryOp::Remainder}};
constexpr OperatorRow kPower[] = {{"^", BinaryOp::Power}};
constexpr std::span<const OperatorRow> kLevels[] = {kOr, kAnd, kEquality, kRelation, kSum, kProduct, kPower};
constexpr int kPowerLevel = 6;

std::optional<BinaryOp> operatorAt(std::string_view rest, int level) {
  if (rest.starts_with("-->") || (level == 3 && rest.starts_with("<>"))) return std::nullopt;
  for (const OperatorRow& row : kLevels[level])
    if (rest.starts_with(row.text)) return row.op;
  return std::nullopt;
}

std::size_t lengthOf(BinaryOp op, int level) {
  for (const OperatorRow& row : kLevels[level])
    if (row.op == op) return row.text.size();
  return 1;
}

double folded(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::Add: return a + b;
    case BinaryOp::Subtract: return a - b;
    case BinaryOp::Multiply: return a * b;
    case BinaryOp::Divide: return a / b;
    case BinaryOp::Remainder: return std::fmod(std::trunc(a), std::trunc(b));
    case BinaryOp::Power: return std::pow(a, b);
    case BinaryOp::Less: return a < b;
    case BinaryOp::LessEqual: return a <= b;
    case BinaryOp::Greater: return a > b;
    case BinaryOp::GreaterEqual: return a >= b;
    case BinaryOp::Equal: return a == b;
    case BinaryOp::NotEqual: return a != b;
    case BinaryOp::And: return a != 0 && b != 0;
    case BinaryOp::Or: return a != 0 || b != 0;
  }
  return 0;
}

}  // namespace

const LSystemFunction* lsystemFunction(std::string_view name) {
  const auto row = std::find_if(std::begin(kFunctions), std::end(kFunctions), [&](const LSystemFunction& f) { return f.name == name; });
  return row == std::end(kFunctions) ? nullptr : row;
}

// ---- places and trouble ------------------------------------------------------------------------------------------------

void LSystemReader::skip() {
  while (at_ < limit_ && isSpace(text_[at_])) ++at_;
}

bool LSystemReader::eat(std::string_view token) {
  skip();
  if (!text_.substr(at_, limit_ - at_).starts_with(token)) return false;
  at_ += token.size();
  return true;
}

void LSystemReader::expect(std::string_view token, std::string_view what) {
  if (broken_ || eat(token)) return;
  errorHere("expected " + std::string(token) + " " + std::string(what) + ", found " + found());
}

void LSystemReader::error(std::size_t begin, std::size_t end, std::string message, std::string hint) {
  if (broken_) return;
  broken_ = true;
  diagnostics_.push_back(source_.diagnostic(Severity::Error, begin, end, std::move(message), std::move(hint)));
}

void LSystemReader::errorHere(std::string message, std::string hint) {
  skip();
  std::size_t end = at_;
  if (end < limit_) {
    while (end < limit_ && isNamePart(text_[end])) ++end;
    end = std::max(end, at_ + 1);
  }
  error(at_, end, std::move(message), std::move(hint));
}

void LSystemReader::warn(std::size_t begin, std::size_t end, std::string message, std::string hint) {
  diagnostics_.push_back(source_.diagnostic(Severity::Warning, begin, end, std::move(message), std::move(hint)));
}

std::string LSystemReader::found() const {
  std::size_t i = at_;
  while (i < limit_ && isSpace(text_[i])) ++i;
  if (i >= limit_) return limit_ >= text_.size() ? "the end of the text" : "the end of the line";
  std::size_t end = i;
  while (end < limit_ && isNamePart(text_[end])) ++end;
  return "'" + std::string(text_.substr(i, std::max(end, i + utf8Length(text_[i])) - i)) + "'";
}

// ---- expressions -------------------------------------------------------------------------------------------------------

ExprId LSystemReader::add(ExprNode node, std::size_t begin) {
  int height = 0;
  const auto under = [&](ExprId id) {
    if (id.valid() && static_cast<std::size_t>(id.value) < heights_.size()) height = std::max(height, heights_[static_cast<std::size_t>(id.value)]);
  };
  if (const auto* u = std::get_if<Unary>(&node)) under(u->operand);
  if (const auto* b = std::get_if<Binary>(&node)) under(b->left), under(b->right);
  if (const auto* c = std::get_if<Conditional>(&node)) under(c->condition), under(c->yes), under(c->no);
  if (const auto* c = std::get_if<Call>(&node)) std::for_each(c->arguments.begin(), c->arguments.end(), under);
  if (const auto* e = std::get_if<Element>(&node)) std::for_each(e->indices.begin(), e->indices.end(), under);
  if (height >= kNesting) error(begin, at_, "this expression is more than " + std::to_string(kNesting) + " operations deep", "split it with a variable");
  std::size_t end = at_;
  while (end > begin && isSpace(text_[end - 1])) --end;
  const ExprId id = grammar_.add(std::move(node), source_.originOf(begin, end));
  heights_.resize(static_cast<std::size_t>(id.value) + 1);
  heights_.back() = height + 1;
  return id;
}

bool LSystemReader::enter() {
  if (++depth_ <= kNesting) return true;
  errorHere("this is nested more than " + std::to_string(kNesting) + " deep");
  return false;
}

ExprId LSystemReader::expression() {
  ExprId result;
  if (enter()) result = conditional();
  leave();
  if (!result.valid()) result = add(Number{}, at_);
  return result;
}

ExprId LSystemReader::conditional() {
  skip();
  const std::size_t begin = at_;
  const ExprId condition = binary(0);
  if (broken_ || !eat("?")) return condition;
  const ExprId yes = expression();
  expect(":", "between the two values of ?");
  if (broken_) return condition;
  const ExprId no = expression();
  return add(Conditional{condition, yes, no}, begin);
}

ExprId LSystemReader::binary(int level) {
  if (level > kPowerLevel) return unary();
  skip();
  const std::size_t begin = at_;
  ExprId left = binary(level + 1);
  bool again = false;
  while (!broken_) {
    skip();
    const auto op = operatorAt(text_.substr(at_, limit_ - at_), level);
    if (!op) break;
    at_ += lengthOf(*op, level);
    if (level == kPowerLevel) warnAboutPower(left, again, begin);
    const ExprId right = binary(level + 1);
    left = add(Binary{*op, left, right}, begin);
    again = true;
  }
  return left;
}

void LSystemReader::warnAboutPower(ExprId left, bool again, std::size_t begin) {
  if (broken_) return;
  if (again) warn(begin, at_, "^ groups from the left here: a^b^c is (a^b)^c", "write the parentheses that you mean");
  else if (text_[begin] == '-' && std::holds_alternative<Unary>(grammar_.at(left).node))
    warn(begin, at_, "- binds tighter than ^ here: -a^b is (-a)^b", "write the parentheses that you mean");
}

ExprId LSystemReader::unary() {
  skip();
  const std::size_t begin = at_;
  const char c = peek();
  if ((c != '-' && c != '!') || atArrow() || (c == '!' && peek(1) == '=')) return primary();
  ++at_;
  ExprId result;
  if (enter()) {
    const ExprId operand = unary();
    result = add(Unary{c == '-' ? UnaryOp::Minus : UnaryOp::Not, operand}, begin);
  }
  leave();
  return result.valid() ? result : add(Number{}, begin);
}

ExprId LSystemReader::primary() {
  skip();
  const std::size_t begin = at_;
  const char c = peek();
  if (c == '(') {
    ++at_;
    const ExprId inner = expression();
    expect(")", "to close the parenthesis");
    return inner;
  }
  if (isDigit(c) || (c == '.' && isDigit(peek(1)))) return number();
  if (c == '"') return quotedText();
  if (!isNameStart(c)) {
    errorHere("expected a value, found " + found());
    return add(Number{}, begin);
  }
  std::string word = name("a value");
  skip();
  if (peek() == '(') return called(std::move(word), begin);
  if (peek() == '[') {
    std::vector<ExprId> index = indices();
    return add(Element{std::move(word), std::move(index)}, begin);
  }
  return add(Name{std::move(word)}, begin);
}

ExprId LSystemReader::number() {
  const std::size_t begin = at_;
  bool point = false;
  while (isDigit(peek()) || (peek() == '.' && !point)) {
    point = point || peek() == '.';
    ++at_;
  }
  const bool exponent = (peek() == 'e' || peek() == 'E') && (isDigit(peek(1)) || ((peek(1) == '+' || peek(1) == '-') && isDigit(peek(2))));
  if (exponent) {
    const std::size_t mantissa = at_;
    at_ += 2;
    while (isDigit(peek())) ++at_;
    if (!point) {
      const std::string digits(text_.substr(begin, mantissa - begin));
      error(begin, at_, "a number with an exponent needs a decimal point", "write " + digits + ".0" + std::string(text_.substr(mantissa, at_ - mantissa)));
    }
  }
  if (isNamePart(peek())) errorHere("a number is followed directly by " + found(), "an operator is missing");
  std::string digits(text_.substr(begin, at_ - begin));
  if (digits.front() == '.') digits.insert(0, "0");
  if (const std::size_t dot = digits.find('.'); dot != std::string::npos && (dot + 1 == digits.size() || !isDigit(digits[dot + 1]))) digits.insert(dot + 1, "0");
  const auto value = parseNumber(digits);
  if (!value) error(begin, at_, "this number is outside what a number can be");
  return add(Number{value.value_or(0), -1}, begin);
}

ExprId LSystemReader::quotedText() {
  const std::size_t begin = at_++;
  std::string words;
  while (peek() != '"') {
    if (atEnd() || peek() == '\n') {
      error(begin, at_, "this text is not closed", "add the missing \"");
      return add(Text{words}, begin);
    }
    if (peek() == '\\' && at_ + 1 < limit_) {
      ++at_;
      const char c = peek();
      words.push_back(c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c);
    } else {
      words.push_back(peek());
    }
    ++at_;
  }
  ++at_;
  return add(Text{std::move(words)}, begin);
}

ExprId LSystemReader::called(std::string function, std::size_t begin) {
  const std::size_t nameEnd = begin + function.size();
  const LSystemFunction* known = lsystemFunction(function);
  if (known == nullptr) {
    std::vector<std::string_view> names;
    for (const LSystemFunction& f : kFunctions) names.push_back(f.name);
    error(begin, nameEnd, "there is no function " + function, didYouMean(function, names));
  }
  ++at_;
  Call call{std::move(function), {}};
  if (!eat(")")) {
    do {
      if (call.function == "fscanf") eat("&");
      call.arguments.push_back(expression());
    } while (!broken_ && eat(","));
    expect(")", "after the arguments of " + call.function);
  }
  const auto count = static_cast<int>(call.arguments.size());
  if (!broken_ && known != nullptr && (count < known->fewest || count > known->most))
    error(begin, at_, call.function + " takes " + (known->most == kManyArguments ? "at least " : "") + std::to_string(known->fewest) +
                          (known->fewest == 1 ? " argument, not " : " arguments, not ") + std::to_string(count));
  return add(std::move(call), begin);
}

std::optional<double> LSystemReader::constantOf(ExprId id) const {
  const ExprNode& node = grammar_.at(id).node;
  if (const auto* n = std::get_if<Number>(&node)) return n->value;
  if (const auto* u = std::get_if<Unary>(&node)) {
    const auto value = constantOf(u->operand);
    if (!value) return std::nullopt;
    return u->op == UnaryOp::Minus ? -*value : (*value == 0 ? 1.0 : 0.0);
  }
  if (const auto* b = std::get_if<Binary>(&node)) {
    const auto left = constantOf(b->left);
    const auto right = constantOf(b->right);
    if (!left || !right) return std::nullopt;
    return folded(b->op, *left, *right);
  }
  if (const auto* c = std::get_if<Conditional>(&node)) {
    const auto condition = constantOf(c->condition);
    if (!condition) return std::nullopt;
    return constantOf(*condition != 0 ? c->yes : c->no);
  }
  return std::nullopt;
}

// ---- statements --------------------------------------------------------------------------------------------------------

std::string LSystemReader::name(std::string_view what) {
  skip();
  const std::size_t begin = at_;
  if (!isNameStart(peek())) {
    errorHere("expected " + std::string(what) + ", found " + found());
    return {};
  }
  while (isNamePart(peek())) ++at_;
  return std::string(text_.substr(begin, at_ - begin));
}

std::vector<ExprId> LSystemReader::indices() {
  std::vector<ExprId> result;
  while (!broken_ && eat("[")) {
    result.push_back(expression());
    skip();
    if (!broken_ && peek() == ',') errorHere("one pair of brackets holds one index", "write a[i][j]");
    expect("]", "after the index");
  }
  return result;
}

Block LSystemReader::block() {
  Block result;
  skip();
  const std::size_t begin = at_;
  expect("{", "to open a block");
  if (broken_) return result;
  if (!enter()) return leave(), result;
  bool trouble = false;
  while (!broken_) {
    skip();
    if (atEnd()) {
      error(begin, begin + 1, "this { is never closed", "add the missing }");
      break;
    }
    if (peek() == '}') break;
    Statement next = statement();
    if (broken_) {
      // The rest of the block is still read, so that all its mistakes are shown.
      trouble = true;
      skipStatement();
      broken_ = false;
      continue;
    }
    result.push_back(std::move(next));
  }
  eat("}");
  if (result.empty() && !trouble) error(begin, at_, "this block is empty", "leave it out, or write a statement");
  leave();
  broken_ = broken_ || trouble;
  return result;
}

void LSystemReader::skipStatement() {
  int depth = 0;
  for (; at_ < limit_; ++at_) {
    const char c = text_[at_];
    if (c == '{') ++depth;
    if (c == '}' && depth-- == 0) return;
    if ((c == ';' && depth == 0) || (c == '}' && depth == 0)) {
      ++at_;
      return;
    }
  }
}

Statement LSystemReader::statement() {
  const std::size_t begin = at_;
  std::string word = isNameStart(peek()) ? name("a statement") : std::string{};
  Statement result;
  if (word == "if") result = ifStatement();
  else if (word == "while") result = whileStatement();
  else if (word == "do") result = doStatement();
  else result = assignment(std::move(word), begin);
  result.where = spanFrom(begin);
  return result;
}

ExprId LSystemReader::parenthesised() {
  expect("(", "before the condition");
  if (broken_) return {};
  const ExprId condition = expression();
  expect(")", "after the condition");
  return condition;
}

Statement LSystemReader::ifStatement() {
  If result;
  result.condition = parenthesised();
  skip();
  if (!broken_ && peek() != '{') errorHere("what if does needs braces", "write if (...) { ... }");
  if (!broken_) result.yes = block();
  const std::size_t before = at_;
  skip();
  const bool otherwise = !broken_ && text_.substr(at_, limit_ - at_).starts_with("else") && !isNamePart(peek(4));
  if (otherwise) {
    at_ += 4;
    skip();
    if (peek() != '{') errorHere("what else does needs braces", "write else { ... }");
    if (!broken_) result.no = block();
  } else {
    at_ = before;
  }
  return {std::move(result), {}};
}

Statement LSystemReader::whileStatement() {
  While result;
  result.condition = parenthesised();
  skip();
  if (!broken_ && peek() != '{') errorHere("what while repeats needs braces", "write while (...) { ... }");
  if (!broken_) result.body = block();
  return {std::move(result), {}};
}

Statement LSystemReader::doStatement() {
  While result;
  result.testFirst = false;
  skip();
  if (peek() != '{') errorHere("what do repeats needs braces", "write do { ... } while (...);");
  if (!broken_) result.body = block();
  expect("while", "after the block of do");
  if (!broken_) result.condition = parenthesised();
  expect(";", "after do { ... } while (...)");
  return {std::move(result), {}};
}

Statement LSystemReader::assignment(std::string word, std::size_t begin) {
  if (word.empty() && peek() == ';') {
    errorHere("there is no statement before this ;", "no ; stands after a }");
    return {};
  }
  skip();
  std::vector<ExprId> index;
  if (!word.empty() && peek() == '[') index = indices();
  skip();
  const bool compound = !word.empty() && peek() != '\0' && std::string_view("+-*/%^").find(peek()) != std::string_view::npos;
  if (compound && (peek(1) == '=' || (peek() == peek(1) && (peek() == '+' || peek() == '-') && peek(2) != '>')))
    errorHere("there is no operator " + std::string(text_.substr(at_, 2)), "write " + word + " = " + word + " " + peek() + " ...;");
  if (broken_) return {};
  if (!word.empty() && peek() == '=' && peek(1) != '=') {
    ++at_;
    const ExprId value = expression();
    expect(";", "after the assignment");
    if (index.empty()) return {Assign{std::move(word), value}, {}};
    return {AssignElement{std::move(word), std::move(index), value}, {}};
  }
  at_ = begin;
  const ExprId value = expression();
  expect(";", "after the statement");
  return {Evaluate{value}, {}};
}

// ---- strings of modules ------------------------------------------------------------------------------------------------

std::vector<Module> LSystemReader::modules(ModuleText kind) {
  std::vector<Module> result;
  skip();
  if (peek() == '*') {
    const std::size_t begin = at_++;
    skip();
    const bool alone = atEnd() || atArrow() || std::string_view("<>:").find(peek()) != std::string_view::npos;
    if (!alone) error(begin, begin + 1, "* stands for nothing and must stand alone", "* is no letter of a string");
    return result;
  }
  while (!broken_) {
    skip();
    if (atEnd() || atArrow() || peek() == '<' || peek() == '>' || peek() == ':') break;
    result.push_back(module(kind));
  }
  return result;
}

Module LSystemReader::module(ModuleText kind) {
  const std::size_t begin = at_;
  const char c = peek();
  if (c == '(') errorHere("this ( follows no letter", "a parameter list belongs to the letter before it");
  else if (c == ')') errorHere("this ) closes nothing");
  else if (c == '*') errorHere("* is no letter of a string", "* stands alone, for nothing");
  else if (static_cast<unsigned char>(c) >= 0x80 || static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
    error(begin, begin + utf8Length(c), "a letter of a string must be a printable ASCII character", "rename it");
  if (broken_) return {};
  Module result;
  result.letter = std::string(1, c);
  ++at_;
  const std::size_t letterEnd = at_;
  skip();
  if (peek() == '(') arguments(result, kind);
  else at_ = letterEnd;
  result.where = spanFrom(begin);
  return result;
}

void LSystemReader::arguments(Module& module, ModuleText kind) {
  const std::size_t open = at_++;
  if (eat(")")) return error(open, at_, "a parameter list has at least one parameter", "write " + module.letter + " without parentheses");
  do {
    const std::size_t begin = (skip(), at_);
    if (kind == ModuleText::Evaluated) {
      module.arguments.push_back(expression());
    } else {
      std::string formal = isNameStart(peek()) ? name("a name") : std::string{};
      skip();
      if (formal.empty() || (peek() != ',' && peek() != ')' && !atEnd())) {
        error(begin, std::max(at_, begin + 1), "a formal parameter must be a name, not an expression", "compare its value in a condition after :");
        return;
      }
      module.arguments.push_back(add(Name{std::move(formal)}, begin));
    }
  } while (!broken_ && eat(","));
  expect(")", "after the parameters of " + module.letter);
  if (module.arguments.size() > kParameters)
    error(open, at_, "a module has at most " + std::to_string(kParameters) + " parameters, this one " + std::to_string(module.arguments.size()));
}

}  // namespace axil::simeco
