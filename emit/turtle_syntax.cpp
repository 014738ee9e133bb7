#include "emit/turtle_syntax.hpp"

#include "base/overloaded.hpp"
#include "base/text.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace axil::emit {

namespace {

using simeco::BinaryOp;

const char* symbolOf(BinaryOp op, TurtleLanguage language) {
  const bool python = language == TurtleLanguage::LPy;
  switch (op) {
    case BinaryOp::Add: return " + ";
    case BinaryOp::Subtract: return " - ";
    case BinaryOp::Multiply: return "*";
    case BinaryOp::Divide: return "/";
    case BinaryOp::Remainder: return "%";
    case BinaryOp::Power: return python ? "**" : "^";
    case BinaryOp::Less: return " < ";
    case BinaryOp::LessEqual: return " <= ";
    case BinaryOp::Greater: return " > ";
    case BinaryOp::GreaterEqual: return " >= ";
    case BinaryOp::Equal: return " == ";
    case BinaryOp::NotEqual: return " != ";
    case BinaryOp::And: return python ? " and " : " && ";
    case BinaryOp::Or: return python ? " or " : " || ";
  }
  return " ";
}

bool isTrigonometric(std::string_view name) { return name == "sin" || name == "cos" || name == "tan"; }
bool isInverse(std::string_view name) { return name == "asin" || name == "acos" || name == "atan" || name == "atan2"; }

}  // namespace

std::string turtleNumber(double value) {
  std::string text = shortest(value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string turtleComment(const std::string& line) {
  std::string text = line;
  for (const char* mark : {"/*", "*/", "//"})
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark)) text.erase(at, 2);
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first);
}

std::optional<double> ExpressionWriter::constant(simeco::ExprId id) const {
  using Value = std::optional<double>;
  return std::visit(overloaded{[](const simeco::Number& x) -> Value { return x.value; },
                               [&](const simeco::Unary& x) -> Value {
                                 const Value v = constant(x.operand);
                                 if (!v) return {};
                                 return x.op == simeco::UnaryOp::Minus ? -*v : (*v == 0 ? 1.0 : 0.0);
                               },
                               [&](const simeco::Binary& x) -> Value {
                                 const Value a = constant(x.left);
                                 const Value b = constant(x.right);
                                 if (!a || !b) return {};
                                 if (x.op == BinaryOp::Add) return *a + *b;
                                 if (x.op == BinaryOp::Subtract) return *a - *b;
                                 if (x.op == BinaryOp::Multiply) return *a * *b;
                                 if (x.op == BinaryOp::Divide && *b != 0) return *a / *b;
                                 return {};
                               },
                               [](const auto&) -> Value { return {}; }},
                    grammar_.at(id).node);
}

std::string ExpressionWriter::chosen(const std::string& condition, const std::string& yes, const std::string& no) const {
  return language_ == TurtleLanguage::LPy ? "(" + yes + " if " + condition + " else " + no + ")" : "(" + condition + " ? " + yes + " : " + no + ")";
}

std::string ExpressionWriter::named(const std::string& value) {
  std::string name = "drawn" + std::to_string(++drawn_);
  draws_.push_back(name + " = " + value);
  return name;
}

std::vector<std::string> ExpressionWriter::takeDraws() { return std::exchange(draws_, {}); }

std::string ExpressionWriter::text(simeco::ExprId id, const Meanings& meanings) {
  const bool python = language_ == TurtleLanguage::LPy;
  return std::visit(
      overloaded{
          [&](const simeco::Number& x) { return turtleNumber(x.value); },
          [&](const simeco::Name& x) {
            const auto meaning = meanings.find(x.name);
            return meaning == meanings.end() ? x.name : meaning->second;
          },
          [&](const simeco::Text&) { return std::string("0"); },
          [&](const simeco::Unary& x) {
            const std::string inner = text(x.operand, meanings);
            return (x.op == simeco::UnaryOp::Minus ? "(-" : python ? "(not " : "(!") + inner + ")";
          },
          [&](const simeco::Binary& x) {
            const std::string left = text(x.left, meanings);
            const std::string right = text(x.right, meanings);
            if (x.op == BinaryOp::Remainder && python) return "fmod(int(" + left + "), int(" + right + "))";
            return "(" + left + symbolOf(x.op, language_) + right + ")";
          },
          [&](const simeco::Chain& x) {
            std::string all;
            for (std::size_t i = 0; i < x.comparisons.size(); ++i) {
              const std::string left = text(x.operands[i], meanings);
              const std::string right = text(x.operands[i + 1], meanings);
              all += (i == 0 ? "" : symbolOf(BinaryOp::And, language_)) + ("(" + left + symbolOf(x.comparisons[i], language_) + right + ")");
            }
            return "(" + all + ")";
          },
          [&](const simeco::Conditional& x) {
            const std::string condition = text(x.condition, meanings);
            const std::string yes = text(x.yes, meanings);
            return chosen(condition, yes, text(x.no, meanings));
          },
          [&](const simeco::Call& x) { return call(x, meanings); },
          [&](const simeco::Element& x) {
            std::string all = x.array;
            for (const simeco::ExprId index : x.indices) {
              const std::string inner = text(index, meanings);
              all += python ? "[int(" + inner + ")]" : "[" + inner + "]";
            }
            return all;
          },
      },
      grammar_.at(id).node);
}

std::string ExpressionWriter::call(const simeco::Call& x, const Meanings& meanings) {
  const bool python = language_ == TurtleLanguage::LPy;
  std::vector<std::string> arguments;
  for (const simeco::ExprId argument : x.arguments) arguments.push_back(text(argument, meanings));
  const auto plain = [&](const std::string& name) {
    std::string all = name + "(";
    for (std::size_t i = 0; i < arguments.size(); ++i) all += (i == 0 ? "" : ", ") + arguments[i];
    return all + ")";
  };
  const std::string& f = x.function;
  if (f == "random" && arguments.size() == 2)
    return named(python ? plain("uniform") : "(" + arguments[0] + " + ran(" + arguments[1] + " - " + arguments[0] + "))");
  if (f == "normal" && arguments.size() == 2) return named(python ? plain("gauss") : plain("nran"));
  if (f == "func" || f == "com") {
    troubles_.push_back("it asks the program around the engine (" + f + "), which only SimEco can do");
    return "0";
  }
  if (python) {
    if (f == "log" || f == "exp" || f == "sqrt" || f == "floor" || f == "ceil" || f == "min" || f == "max" || f == "pow" || f == "abs" || f == "sign" ||
        isTrigonometric(f) || isInverse(f))
      return plain(f);
    if (f == "round") return "floor(" + arguments[0] + " + 0.5)";
  }
  // The classic language's angles are degrees.
  constexpr double kDegrees = 180 / std::numbers::pi;
  if (isTrigonometric(f)) return f + "(" + arguments[0] + "*" + turtleNumber(kDegrees) + ")";
  if (isInverse(f)) return "(" + plain(f) + "/" + turtleNumber(kDegrees) + ")";
  if (f == "min" || f == "max") {
    const char* order = f == "min" ? " < " : " > ";
    return chosen(arguments[0] + order + arguments[1], arguments[0], arguments[1]);
  }
  if (f == "pow") return "(" + arguments[0] + "^" + arguments[1] + ")";
  if (f == "abs") return plain("fabs");
  if (f == "round") return "floor(" + arguments[0] + " + 0.5)";
  if (f == "log" || f == "exp" || f == "sqrt" || f == "floor" || f == "ceil" || f == "sign") return plain(f);
  troubles_.push_back("it calls " + f + ", which the language does not have");
  return "0";
}

}  // namespace axil::emit
