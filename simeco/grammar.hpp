#pragma once
/// \file
/// Grammar: an L-system as a value. Every front end (SimEco 1.0 and 1.1 text, the classic L-system text of .l files)
/// parses into it, `emit` builds it, the printer writes it, the engine derives it; the engine knows no syntax.
///
/// A Grammar is an *ecosystem* of plants. Each plant has attributes, organ blocks with stages, and its rules. Expressions
/// live in one arena, `Grammar::expressions`; an ExprId is an index into it. Equality compares what is said, not where it
/// stands: arenas in another order, spans and blanks do not matter, comments do.
/// Sources: L-Grammar Generator 2005, section 3.4 and appendix (SimEco); RTIL-system 2010 (L-systems); docs/simeco.md.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/ids.hpp"
#include "base/source.hpp"

namespace axil::simeco {

struct Grammar;

// ---- expressions -----------------------------------------------------------------------------------------------------

struct ExprTag;
using ExprId = Id<ExprTag>;

/// A literal. `decimals` is how it is printed: that many digits after the point, or -1 for the shortest text that reads
/// back as `value`. A literal made by `fixedNumber` is already rounded to its decimals, so printing is exact.
struct Number {
  double value = 0;
  int decimals = -1;
  friend bool operator==(const Number&, const Number&) = default;
};
[[nodiscard]] Number fixedNumber(double value, int decimals);
/// How a literal is printed: with its decimals when that reads back as `value`, else the shortest text that does.
[[nodiscard]] std::string textOf(const Number& number);

/// A formal parameter, a variable, an environment attribute.
struct Name {
  std::string name;
};

/// A quoted text: the value of Model, the format of printf.
struct Text {
  std::string text;
};

enum class UnaryOp { Minus, Not };
struct Unary {
  UnaryOp op{};
  ExprId operand;
};

enum class BinaryOp { Add, Subtract, Multiply, Divide, Remainder, Power, Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual, And, Or };
struct Binary {
  BinaryOp op{};
  ExprId left;
  ExprId right;
};

/// `1002 < i < 1006`: every neighbouring pair must hold. Three or more operands (two are a Binary); `comparisons` has one
/// entry fewer.
struct Chain {
  std::vector<ExprId> operands;
  std::vector<BinaryOp> comparisons;
};

struct Conditional {
  ExprId condition;
  ExprId yes;
  ExprId no;
};

/// `random(0.1, 0.2)`, `vector(0, 1, 0)`, `RGBA(...)`, `sin(x)`.
struct Call {
  std::string function;
  std::vector<ExprId> arguments;
};

/// `a[i][j]`.
struct Element {
  std::string array;
  std::vector<ExprId> indices;
};

using ExprNode = std::variant<Number, Name, Text, Unary, Binary, Chain, Conditional, Call, Element>;
struct Expr {
  ExprNode node;
  SourceSpan where;
};

// ---- statements ------------------------------------------------------------------------------------------------------

struct Statement;
using Block = std::vector<Statement>;

struct Assign {
  std::string name;
  ExprId value;
};
struct AssignElement {
  std::string array;
  std::vector<ExprId> indices;
  ExprId value;
};
struct Evaluate {
  ExprId value;
};
struct If {
  ExprId condition;
  Block yes;
  Block no;
};
struct While {
  ExprId condition;
  Block body;
  bool testFirst = true;  ///< false: do {...} while (...);
};
struct Statement {
  std::variant<Assign, AssignElement, Evaluate, If, While> node;
  SourceSpan where;
};

// ---- rules -----------------------------------------------------------------------------------------------------------

/// Comments as they stand, with their // or /* */. An empty line in `before` or `inside` is a blank line of the text; it is
/// kept for the reader and does not matter to equality.
struct Comments {
  std::vector<std::string> before = {};  ///< in lines of their own above the thing
  std::string trailing = {};             ///< after it on its last line
  std::string opening = {};              ///< of a block: after its { on the same line
  std::vector<std::string> inside = {};  ///< of a block: above its }
  friend bool operator==(const Comments& a, const Comments& b);
};

/// One letter of the L-system string. In a predecessor or context an argument that is a Name binds a formal parameter and
/// a Number must be met exactly (`S(2)`, `S(i)`); in an axiom or successor arguments are expressions.
struct Module {
  std::string letter;  ///< "S", "rotr", "[", "F", "@Gs"
  std::vector<ExprId> arguments;
  SourceSpan where;
};

/// One way a production can go. A weight is only given where there is a choice.
struct Successor {
  std::vector<Module> modules;
  std::optional<ExprId> weight;
};

/// Where a condition stands in the text, so that it is printed back there: `S(i) -> S(i+1, lo < i < hi)`,
/// `S(i, lo < i < hi) -> S(i+1)`, or `pred : condition --> succ`.
enum class ConditionPlace { AfterColon, InSuccessor, InPredecessor };

/// left < predecessor > right : {before} condition {after} -> successors. At least one predecessor and one successor, which
/// may say nothing; everything else may be empty.
struct Production {
  std::vector<Module> left;
  std::vector<Module> predecessor;
  std::vector<Module> right;
  Block before;
  std::optional<ExprId> condition;
  ConditionPlace conditionPlace = ConditionPlace::AfterColon;
  Block after;
  std::vector<Successor> successors;
  Comments comments;
  SourceSpan where;
};

/// Whether an expression is a comparison or joins comparisons, so that as a module's last argument it is a condition.
[[nodiscard]] bool isCondition(const Grammar& grammar, ExprId id);
/// Where a production's condition can be printed: its own place where a module and a comparison are there for it, else
/// after a colon.
[[nodiscard]] ConditionPlace placeOfCondition(const Grammar& grammar, const Production& production);

/// Which letters contexts pass over.
struct ContextFilter {
  enum class Mode { None, Ignore, Consider } mode = Mode::None;
  std::vector<std::string> letters;
  Comments comments = {};
  friend bool operator==(const ContextFilter&, const ContextFilter&) = default;
};

struct ArrayDeclaration {
  std::string name;
  std::vector<int> sizes;
  std::vector<ExprId> initial;  ///< row-major; missing ones are 0
};

/// Decomposition or homomorphism: context rules applied within one step, or only on interpretation.
struct SubRules {
  int maximumDepth = 1;
  std::optional<std::uint64_t> seed;
  bool warnAtMaximumDepth = true;
  std::vector<Production> productions;
};

/// One L-system: axiom and productions, and what the classic language adds.
struct RuleSet {
  std::string label;  ///< "w" in SimEco; a number names a sub-L-system
  std::vector<Module> axiom;
  std::vector<Production> productions;  ///< first match in this order fires
  std::optional<SubRules> decomposition;
  std::optional<SubRules> homomorphism;
  std::vector<Production> interaction;  ///< RTIL: rules for selected modules only
  ContextFilter filter;
  bool ring = false;
  std::optional<std::uint64_t> seed;       ///< classic language: given = stochastic choice is on
  std::optional<ExprId> derivationLength;  ///< none: until nothing changes (SimEco)
  std::vector<ArrayDeclaration> arrays;
  std::vector<std::string> externals;  ///< variables taken from the calling L-system
  Block start;
  Block startEach;
  Block endEach;
  Block end;
  Comments axiomComments;
  Comments comments;  ///< of the whole block (SimEco's Grow)
};

// ---- plants ----------------------------------------------------------------------------------------------------------

/// `GrowRate = 0.1;`, `Model = "ovate.i";`, `Position = vector(0, 0, 0);`. Unknown names are kept.
struct Attribute {
  std::string name;
  ExprId value;
  Comments comments;
  SourceSpan where;
};

/// `Stage 3 { ... }`: one numbered kind of an organ. `Stage 3(length, radius) { GrowRate = length; ... }` names the further arguments
/// of its modules, S(3, 0.2, 0.01), for its attributes.
struct Stage {
  int number = 0;
  std::vector<std::string> parameters;  ///< SimEco 1.1
  std::vector<Attribute> attributes;
  Comments comments;
  SourceSpan where;
};

enum class OrganKind { Apex, Stem, Leaf, Root, Fruit, Flower };
/// The letter that stands for the organ in rules: A, S, L, R, F, W.
[[nodiscard]] const char* letterOf(OrganKind kind);
/// The keyword of its block: "Apex", "Stem", ...
[[nodiscard]] const char* keywordOf(OrganKind kind);
[[nodiscard]] std::optional<OrganKind> organOfLetter(const std::string& letter);

struct OrganBlock {
  OrganKind kind{};
  std::vector<Attribute> attributes;
  std::vector<Stage> stages;
  Comments comments;
  SourceSpan where;
};

struct PlantGrammar {
  std::string name;
  std::vector<Attribute> attributes;
  std::vector<OrganBlock> organs;
  RuleSet rules;
  std::vector<RuleSet> subRules;  ///< further L-systems of the same file, entered by `?(label, scale)`
  Comments comments;
  SourceSpan where;
};

/// Where the lines of a grammar's text start and what its file is called, so that the engine can say where a rule stands without
/// having the text. Empty for a grammar that was built, not read.
struct SourceLines {
  std::string file = {};
  std::vector<std::uint32_t> starts = {};
};
[[nodiscard]] SourceLines linesOf(std::string_view text);

/// Which language a grammar was written in, and is printed in.
enum class Language { SimEco, LSystem };

struct Grammar {
  Language language = Language::SimEco;
  std::string version = "1.0";  ///< SimEco: "1.0" or "1.1"
  std::string name;
  std::vector<Attribute> attributes;
  std::vector<PlantGrammar> plants;
  std::vector<Expr> expressions;
  Comments comments;                 ///< `before` heads the file
  std::vector<std::string> closing;  ///< comments after the last brace
  SourceLines source;                ///< does not matter to equality

  ExprId add(ExprNode node, SourceSpan where = {});
  [[nodiscard]] const Expr& at(ExprId id) const { return expressions[static_cast<std::size_t>(id.value)]; }

  /// The same language, attributes, plants, rules and comments, expressions compared by content.
  friend bool operator==(const Grammar& a, const Grammar& b);
};

/// Where something of the grammar stands in its text: "plant.l:12", "line 12" without a file, "" when nobody knows.
[[nodiscard]] std::string lineOf(const Grammar& grammar, SourceSpan where);

}  // namespace axil::simeco
