#include "emit/turtle_statements.hpp"

#include "base/overloaded.hpp"

#include <utility>
#include <variant>

namespace axil::emit {

namespace {

using simeco::ExprId;

void assigned(const simeco::Block& block, std::set<std::string>& names) {
  for (const simeco::Statement& s : block) {
    if (const auto* assign = std::get_if<simeco::Assign>(&s.node)) names.insert(assign->name);
    if (const auto* branch = std::get_if<simeco::If>(&s.node)) assigned(branch->yes, names), assigned(branch->no, names);
    if (const auto* loop = std::get_if<simeco::While>(&s.node)) assigned(loop->body, names);
  }
}

}  // namespace

std::string StatementWriter::cpfgStatements(const simeco::Block& block, const std::vector<std::string>& draws) {
  std::string text;
  for (const std::string& draw : draws) text += draw + "; ";
  for (const simeco::Statement& s : block) {
    std::string own = std::visit(
        overloaded{[&](const simeco::Assign& x) { return x.name + " = " + writer_.text(x.value) + "; "; },
                   [&](const simeco::AssignElement& x) {
                     std::string place = x.array;
                     for (const ExprId index : x.indices) place += "[" + writer_.text(index) + "]";
                     return place + " = " + writer_.text(x.value) + "; ";
                   },
                   [&](const simeco::Evaluate& x) { return writer_.text(x.value) + "; "; },
                   [&](const simeco::If& x) {
                     std::string all = "if (" + writer_.text(x.condition) + ") {" + cpfgStatements(x.yes) + "} ";
                     return x.no.empty() ? all : all + "else {" + cpfgStatements(x.no) + "} ";
                   },
                   [&](const simeco::While& x) {
                     const std::string condition = writer_.text(x.condition);
                     const std::string body = "{" + cpfgStatements(x.body) + "} ";
                     return x.testFirst ? "while (" + condition + ") " + body : "do " + body + "while (" + condition + "); ";
                   }},
        s.node);
    for (const std::string& draw : writer_.takeDraws()) text += draw + "; ";
    text += own;
  }
  return text;
}

std::string StatementWriter::cpfgBlock(const char* name, const simeco::Block& block, const std::vector<std::string>& draws) {
  std::string text = cpfgStatements(block);
  for (const std::string& draw : draws) text += draw + "; ";
  return text.empty() ? text : std::string(name) + ": {" + text + "}\n";
}

std::string StatementWriter::cpfgArrays() {
  std::string text = "define: { array ";
  for (const simeco::ArrayDeclaration& array : rules_.arrays) {
    if (&array != &rules_.arrays.front()) text += ",\n  ";
    text += array.name;
    for (const int size : array.sizes) text += "[" + std::to_string(size) + "]";
    for (std::size_t i = 0; i < array.initial.size(); ++i) text += (i == 0 ? "={" : ",") + writer_.text(array.initial[i]);
    if (!array.initial.empty()) text += "}";
  }
  return text + "; }\n";
}

std::string StatementWriter::pythonStatements(const simeco::Block& block, const std::string& indent) {
  std::string text;
  for (const simeco::Statement& s : block) {
    std::string own = std::visit(
        overloaded{[&](const simeco::Assign& x) { return indent + x.name + " = " + writer_.text(x.value) + "\n"; },
                   [&](const simeco::AssignElement& x) {
                     std::string place = x.array;
                     for (const ExprId index : x.indices) place += "[int(" + writer_.text(index) + ")]";
                     return indent + place + " = " + writer_.text(x.value) + "\n";
                   },
                   [&](const simeco::Evaluate& x) { return indent + writer_.text(x.value) + "\n"; },
                   [&](const simeco::If& x) {
                     std::string all = indent + "if " + writer_.text(x.condition) + ":\n" + bodyOf(x.yes, indent);
                     return x.no.empty() ? all : all + indent + "else:\n" + bodyOf(x.no, indent);
                   },
                   [&](const simeco::While& x) {
                     const std::string condition = writer_.text(x.condition);
                     if (x.testFirst) return indent + "while " + condition + ":\n" + bodyOf(x.body, indent);
                     return indent + "while True:\n" + bodyOf(x.body, indent) + indent + "  if not " + condition + ": break\n";
                   }},
        s.node);
    for (const std::string& draw : writer_.takeDraws()) text += indent + draw + "\n";
    text += own;
  }
  return text;
}

std::string StatementWriter::bodyOf(const simeco::Block& block, const std::string& indent) {
  return block.empty() ? indent + "  pass\n" : pythonStatements(block, indent + "  ");
}

std::string StatementWriter::globalLine(const std::string& indent) const {
  std::string line;
  for (const std::string& name : globals()) line += (line.empty() ? indent + "global " : ", ") + name;
  return line.empty() ? line : line + "\n";
}

std::string StatementWriter::pythonBlock(const char* name, const simeco::Block& block) {
  return block.empty() ? std::string{} : "\ndef " + std::string(name) + "():\n" + globalLine("  ") + pythonStatements(block, "  ");
}

std::string StatementWriter::pythonArray(const simeco::ArrayDeclaration& array) {
  std::vector<std::string> values;
  std::size_t total = 1;
  for (const int size : array.sizes) total *= static_cast<std::size_t>(size);
  for (std::size_t i = 0; i < total; ++i) values.push_back(i < array.initial.size() ? writer_.text(array.initial[i]) : "0");
  // Rows are folded from the innermost index outwards.
  for (std::size_t level = array.sizes.size(); level-- > 0;) {
    const auto width = static_cast<std::size_t>(array.sizes[level]);
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < values.size(); i += width) {
      std::string row = "[";
      for (std::size_t k = 0; k < width; ++k) row += (k == 0 ? "" : ",") + values[i + k];
      rows.push_back(row + "]");
    }
    values = std::move(rows);
  }
  return array.name + " = " + values.front() + "\n";
}

std::set<std::string> StatementWriter::globals() const {
  std::set<std::string> names;
  for (const simeco::Block* block : {&rules_.start, &rules_.startEach, &rules_.endEach, &rules_.end}) assigned(*block, names);
  return names;
}

}  // namespace axil::emit
