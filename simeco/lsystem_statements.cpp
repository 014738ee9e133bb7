// Statements and strings of modules of the L-system reader; expressions are in lsystem_reader.cpp.
#include "simeco/lsystem_reader.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <utility>

namespace axil::simeco {

namespace {

constexpr std::size_t kParameters = 20;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isNamePart(char c) { return isNameStart(c) || isDigit(c) || c == '_'; }

}  // namespace

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
      // An open text has taken the } with it.
      if (!openText_) error(begin, begin + 1, "this { is never closed", "add the missing }");
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
    const bool chained = text_.substr(at_, limit_ - at_).starts_with("if") && !isNamePart(peek(2));
    if (peek() != '{') errorHere("what else does needs braces", chained ? "write else { if (...) { ... } }" : "write else { ... }");
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
  const bool typed = (word == "int" || word == "float" || word == "double" || word == "var" || word == "let") && isNameStart(peek());
  if (typed) error(begin, begin + word.size(), "variables have no type", "leave out " + word + "; a name is a variable once it is given a value");
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
