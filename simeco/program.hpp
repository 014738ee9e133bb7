#pragma once
/// \file
/// Program: the rules of one plant made ready to run. Letters become one-byte symbol codes, names become slots, expressions
/// and statements become short instruction lists, constants are folded, and the commonest successor parameters (a constant,
/// a parameter, a parameter times or plus a constant) need no instructions at all. A Program is immutable; engine.hpp runs it.
///
/// Fails with BadGrammar, listing everything that cannot be run: names nobody bound, unknown functions, wrong numbers of
/// arguments, expressions nested deeper than the limit.

#include "base/result.hpp"
#include "simeco/grammar.hpp"
#include "simeco/module_string.hpp"
#include "simeco/rule_info.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace axil::simeco {

/// What a function of an expression does. Angles are radians in SimEco and degrees in the classic language.
enum class Function : std::uint8_t {
  Sin, Cos, Tan, Asin, Acos, Atan, Atan2, SinDegrees, CosDegrees, TanDegrees, AsinDegrees, AcosDegrees, AtanDegrees, Atan2Degrees,
  Exp, Log, Sqrt, Absolute, Floor, Ceil, Round, Sign, Minimum, Maximum, Power,
  Random, Normal, Ran, Nran, Bran, Biran, SeedRandom, Stop, SetLength, GetLength
};

/// A function that expressions may call, by name and number of arguments.
struct FunctionRow {
  const char* name;
  int arguments;
  Function function;
};
/// Every function of a language except those of the host (func, com) and printf, which take any number of arguments.
[[nodiscard]] std::vector<FunctionRow> functionsOf(Language language);

enum class Op : std::uint8_t {
  Constant, Local, Global, Element, Minus, Not, Truth,
  Add, Subtract, Multiply, Divide, Remainder, Power, Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual,
  Call, HostFunction, HostExchange, HostPrint, HostFile,
  StoreLocal, StoreGlobal, StoreElement, Drop, Jump, JumpIfZero, LoopBack
};

/// One instruction of the stack machine. `index` is a slot, a function, a text, an array, or where to go on.
struct Instruction {
  Op op = Op::Constant;
  std::uint8_t count = 0;   ///< arguments or indices
  std::int32_t index = 0;
  double value = 0;
};

/// Instructions [first, end) of a Program, which need `depth` places of stack.
struct Code {
  std::int32_t first = 0;
  std::int32_t end = 0;
  std::int32_t depth = 0;
  [[nodiscard]] bool empty() const { return first == end; }
};

/// One number to compute from a frame of locals.
struct Term {
  enum class Kind : std::uint8_t { Constant, Local, LocalTimes, LocalPlus, LocalOver, LocalCompared, Coded } kind = Kind::Constant;
  Op comparison = Op::Less;      ///< LocalCompared: local OP value
  std::uint16_t slot = 0;
  std::int32_t code = -1;        ///< Coded: index into Program::codes
  double value = 0;
};

/// A parameter of a predecessor or context that must be met exactly: S(2).
struct Demand {
  std::uint16_t offset = 0;      ///< of the module's parameters
  double value = 0;
};

/// A module of a predecessor or context: its symbol, the frame slot where its parameters start, what they must be.
struct Pattern {
  enum class Kind : std::uint8_t { Symbol, SkipRest } kind = Kind::Symbol;  ///< SkipRest: `=` of a right context
  SymbolCode code = 0;
  std::uint16_t slot = 0;
  std::vector<Demand> demands;
};

struct CompiledSuccessor {
  std::vector<SymbolCode> codes;
  std::vector<std::uint64_t> keys; ///< one a module, for its identity
  std::vector<Term> terms;       ///< parameters of all its modules, in order
  bool constant = true;          ///< every term is a constant
  std::vector<double> values;    ///< of a constant successor
  Term weight;
};

struct CompiledRule {
  std::vector<Pattern> predecessor;
  std::vector<Pattern> left;     ///< nearest module first
  std::vector<Pattern> right;
  Code before;
  Code after;
  bool hasCondition = false;
  Term condition;
  std::vector<CompiledSuccessor> successors;
  std::uint32_t number = 0;      ///< in text order within its table
  std::uint32_t id = 0;          ///< index into Program::rules; of the main L-system's productions the same as `number`
  std::uint16_t frame = 0;       ///< locals: parameters of predecessor, left, right, then variables
  std::uint16_t bound = 0;       ///< of these, how many are parameters
  bool statements = false;
  bool random = false;           ///< its condition, weights or parameters draw random numbers
  bool randomCondition = false;  ///< it may fire by chance
  bool simpleRight = true;       ///< its right context has no brackets and no `=`
  SourceSpan where;
  std::string name;              ///< "S(4) -> ... (plant.simeco:12)", for messages
};

/// Rules by the symbol that their predecessor starts with. Where many rules want one number each (S(1), S(2), ...), they are
/// found by that number.
struct RuleIndex {
  std::vector<std::uint32_t> all;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> byNumber;  ///< bits of the first parameter
  std::vector<std::uint32_t> otherwise;
  bool numbered = false;
};

struct RuleTable {
  std::vector<CompiledRule> rules;
  std::vector<RuleIndex> bySymbol;  ///< one a symbol
  int maximumDepth = 1;
  std::optional<std::uint64_t> seed;
  bool warn = true;
  bool draws = false;               ///< some rule draws random numbers
  [[nodiscard]] bool empty() const { return rules.empty(); }
};

struct ArrayLayout {
  std::string name;
  std::vector<int> sizes;
  std::size_t first = 0;            ///< among all array elements of its L-system
  std::vector<Term> initial;
};

/// One L-system of the plant: the main one, or a sub-L-system entered by `?(label, scale)`.
struct System {
  std::string label;
  std::vector<SymbolCode> axiomCodes;
  std::vector<std::uint64_t> axiomKeys;
  std::vector<Term> axiomTerms;
  RuleTable productions;
  RuleTable decomposition;
  RuleTable homomorphism;
  RuleTable interaction;
  std::array<bool, 256> ignored{};
  bool ring = false;
  std::optional<std::uint64_t> seed;  ///< the file's own; its draws are other ones with another
  bool stochastic = false;          ///< the applicable rules share their weights; else the first one fires
  std::optional<Term> derivationLength;
  Code start, startEach, endEach, end;
  std::vector<std::string> globals; ///< names, by slot
  std::vector<std::string> externals;
  std::vector<ArrayLayout> arrays;
  std::size_t arrayElements = 0;
};

struct Program {
  Language language = Language::SimEco;
  std::shared_ptr<const std::vector<Symbol>> symbols;
  std::array<std::uint8_t, 256> parameterCount{};
  std::array<bool, 256> opens{};    ///< "["
  std::array<bool, 256> closes{};   ///< "]"
  int cut = -1;                     ///< code of "%", or -1
  int enter = -1;                   ///< code of "?(id, scale)", or -1
  int leave = -1;                   ///< code of "$", or -1
  std::vector<System> systems;      ///< the main one first
  std::vector<RuleInfo> rules;      ///< all rules by id: the main productions first, in text order
  bool draws = false;               ///< a derivation draws random numbers: modules need identities
  bool imageDraws = false;          ///< so does the homomorphism
  std::vector<Instruction> instructions;
  std::vector<Code> codes;
  std::vector<std::string> texts;

  [[nodiscard]] const System& main() const { return systems.front(); }
};

struct CompileOptions {
  int expressionDepth = 200;
};

/// Makes plant number `plant` of `grammar` ready to run.
[[nodiscard]] Result<std::shared_ptr<const Program>> compile(const Grammar& grammar, std::size_t plant, const CompileOptions& options = {});

/// An expression of an attribute, ready to be evaluated for each organ; names are those in `locals` (values in that order) and the environment's.
struct CompiledExpression {
  std::shared_ptr<const Program> program;
  Term term;
  [[nodiscard]] bool isConstant() const { return term.kind == Term::Kind::Constant; }
};
[[nodiscard]] Result<CompiledExpression> compileExpression(const Grammar& grammar, ExprId id, const std::vector<std::string>& locals = {},
                                                               const CompileOptions& options = {});

}  // namespace axil::simeco
