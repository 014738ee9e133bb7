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
  const bool looksAlike = hint.empty() && (message.ends_with("'\u2212'") || message.ends_with("'\u2013'"));
  if (looksAlike) hint = "this dash is not the minus sign -";
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
    errorHere("expected a value, found " + found(), valueHint());
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

std::string LSystemReader::valueHint() const {
  if (peek() == '+') return "a value has no sign +; branches stand in [ ], parentheses hold parameters";
  if (peek() == '*' && at_ > 0 && text_[at_ - 1] == '*') return "a power is written ^";
  if (peek() == '&' || peek() == '|') return "write && for and, || for or";
  return {};
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
      openText_ = true;
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
    const bool statement = function == "if" || function == "while" || function == "do";
    error(begin, nameEnd, "there is no function " + function,
          statement ? "statements stand in braces: { " + function + " (...) { ... } }" : function == "for" ? "write i = 0; while (i < n) { ...; i = i+1; }" : didYouMean(function, names));
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

}  // namespace axil::simeco
