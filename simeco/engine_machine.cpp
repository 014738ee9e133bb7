#include "simeco/engine_machine.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cstdio>

namespace axil::simeco {

namespace {

std::int32_t deepest(const Program& program) {
  std::int32_t depth = 1;
  const auto look = [&](const Code& code) { depth = std::max(depth, code.depth); };
  const auto lookAll = [&](const RuleTable& table) {
    for (const CompiledRule& rule : table.rules) {
      look(rule.before);
      look(rule.after);
    }
  };
  for (const Code& code : program.codes) look(code);
  for (const System& system : program.systems) {
    for (const Code* code : {&system.start, &system.startEach, &system.endEach, &system.end}) look(*code);
    for (const RuleTable* table : {&system.productions, &system.decomposition, &system.homomorphism, &system.interaction}) lookAll(*table);
  }
  return depth;
}

/// One conversion of a printf format with its number; only numbers are converted, anything else is printed as it stands.
std::string converted(const std::string& conversion, double value) {
  char text[512];
  const char kind = conversion.back();
  if (kind == 'd' || kind == 'i' || kind == 'c' || kind == 'x' || kind == 'u') {
    const std::string whole = conversion.substr(0, conversion.size() - 1) + "ll" + (kind == 'c' ? 'd' : kind);
    const double limited = std::clamp(truncated(value), -9e18, 9e18);
    std::snprintf(text, sizeof text, whole.c_str(), static_cast<long long>(limited));
  } else {
    std::snprintf(text, sizeof text, conversion.c_str(), value);
  }
  return text;
}

std::string formatted(const std::string& format, std::span<const double> values) {
  std::string text;
  std::size_t next = 0;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') {
      text += format[i];
      continue;
    }
    if (i + 1 < format.size() && format[i + 1] == '%') {
      text += '%';
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < format.size() && end - i < 12 && std::string_view("0123456789.+- #").find(format[end]) != std::string_view::npos) ++end;
    const bool number = end < format.size() && std::string_view("diuxceEfgG").find(format[end]) != std::string_view::npos;
    if (!number || next >= values.size()) {
      text += '%';
      continue;
    }
    text += converted(format.substr(i, end + 1 - i), values[next++]);
    i = end;
  }
  return text;
}

}  // namespace

Machine::Machine(const SharedSettings& shared) : shared_(&shared), stack_(static_cast<std::size_t>(deepest(*shared.program)) + 2) {}

std::size_t Machine::elementAt(const Instruction& instruction, const double* indices) {
  const ArrayLayout& array = system_->arrays[static_cast<std::size_t>(instruction.index)];
  std::size_t element = 0;
  for (std::size_t i = 0; i < array.sizes.size(); ++i) {
    const double wanted = truncated(indices[i]);
    const double inside = std::clamp(wanted, 0.0, static_cast<double>(array.sizes[i] - 1));
    if (wanted != inside) {
      ++clampedIndices;
      if (shared_->program->language == Language::SimEco) giveUp(ErrorCode::NoAnswer, "an index of array " + array.name + " is outside it");
    }
    element = element * static_cast<std::size_t>(array.sizes[i]) + static_cast<std::size_t>(inside);
  }
  return array.first + element;
}

double Machine::called(const Instruction& instruction, const double* arguments) {
  const auto function = static_cast<Function>(instruction.index);
  if (const auto value = pureFunction(function, arguments)) return *value;
  if (drawsRandom(function)) return drawn(function, arguments, rng_);
  switch (function) {
    case Function::SeedRandom: {
      newSeed = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(truncated(arguments[0]), -9e18, 9e18)));
      rng_ = Rng(*newSeed);
      return 0;
    }
    case Function::Stop: stopAsked = true; return 0;
    case Function::SetLength: newLength = static_cast<std::int64_t>(std::clamp(truncated(arguments[0]), 0.0, 1e15)); return 0;
    case Function::GetLength: return static_cast<double>(newLength.value_or(length));
    default: return 0;
  }
}

double Machine::hostFunction(std::span<const double> arguments) {
  if (!shared_->host->function) {
    giveUp(ErrorCode::BadInput, "func(" + std::to_string(static_cast<std::int64_t>(truncated(arguments[0]))) +
                                    ", ...) is called, but nobody answers it; write the function into the view file beside the grammar, function: 0 0  0.5 1  1 0, or ask by a program that has it");
    return 0;
  }
  const Result<double> answer = shared_->host->function(static_cast<std::int64_t>(truncated(arguments[0])), arguments.subspan(1));
  if (answer) return *answer;
  if (!trouble_) trouble_ = answer.error();
  return 0;
}

void Machine::hostExchange(std::span<double> variables) {
  if (!shared_->host->exchange) return giveUp(ErrorCode::BadInput, "com(...) is called, but nothing answers it here");
  const Result<void> done = shared_->host->exchange(variables);
  if (!done && !trouble_) trouble_ = done.error();
}

void Machine::hostFile(const Instruction& instruction, std::span<double> values) {
  const auto& files = shared_->host->files;
  const auto call = static_cast<FileCall>(instruction.value);
  if (call == FileCall::Open) values[0] = 0;
  const auto result = files ? files(call, shared_->program->texts[static_cast<std::size_t>(instruction.index)], values) : Result<double>(0);
  if (!result) return giveUp(result.error().code, result.error().message);
  values[0] = *result;
}

void Machine::hostPrint(const std::string& format, std::span<const double> values) {
  if (shared_->host->print) shared_->host->print(formatted(format, values));
}

std::string SharedSettings::tooLate() const { return "the derivation took longer than its limit of " + shortest(limits->seconds) + " s"; }

bool Machine::mayLoop(std::int64_t& loops) {
  constexpr std::int64_t betweenLooks = 1 << 14;
  if (++loops > shared_->limits->loopIterations) {
    giveUp(ErrorCode::LimitReached, "a loop ran more than " + std::to_string(shared_->limits->loopIterations) + " times");
    return false;
  }
  if (loops % betweenLooks != 0) return true;
  if (shared_->watch->cancelled()) giveUp(ErrorCode::Cancelled, "the derivation was cancelled");
  if (shared_->late()) giveUp(ErrorCode::LimitReached, shared_->tooLate() + ", in a loop");
  return !trouble_;
}

double Machine::run(const Code& code, double* locals) {
  const Instruction* const program = shared_->program->instructions.data();
  double* top = stack_.data();  // one above the uppermost value
  std::int64_t loops = 0;
  for (std::int32_t at = code.first; at < code.end; ++at) {
    const Instruction& x = program[at];
    switch (x.op) {
      case Op::Constant: *top++ = x.value; break;
      case Op::Local: *top++ = locals[x.index]; break;
      case Op::Global: *top++ = instance_->globals[static_cast<std::size_t>(x.index)]; break;
      case Op::Element:
        top -= x.count;
        *top = instance_->elements[elementAt(x, top)];
        ++top;
        break;
      case Op::Minus: top[-1] = -top[-1]; break;
      case Op::Not: top[-1] = top[-1] == 0 ? 1 : 0; break;
      case Op::Truth: top[-1] = top[-1] != 0 ? 1 : 0; break;
      case Op::Add: --top; top[-1] += *top; break;
      case Op::Subtract: --top; top[-1] -= *top; break;
      case Op::Multiply: --top; top[-1] *= *top; break;
      case Op::Divide:
      case Op::Remainder:
        --top;
        if (dividesByZero(x.op, *top)) {
          giveUp(ErrorCode::NoAnswer, "a division by zero");
          return 0;
        }
        top[-1] = arithmetic(x.op, top[-1], *top);
        break;
      case Op::Power:
      case Op::Less:
      case Op::LessEqual:
      case Op::Greater:
      case Op::GreaterEqual:
      case Op::Equal:
      case Op::NotEqual:
        --top;
        top[-1] = arithmetic(x.op, top[-1], *top);
        break;
      case Op::Call:
        top -= x.count;
        *top = called(x, top);
        ++top;
        break;
      case Op::HostFunction:
        top -= x.count;
        *top = hostFunction({top, x.count});
        ++top;
        break;
      case Op::HostExchange: hostExchange({top - x.count, x.count}); break;
      case Op::HostPrint:
        top -= x.count;
        hostPrint(shared_->program->texts[static_cast<std::size_t>(x.index)], {top, x.count});
        *top++ = 0;
        break;
      case Op::HostFile:
        top -= x.count;
        hostFile(x, {top, x.count == 0 ? std::size_t{1} : x.count});
        top += std::max<std::size_t>(x.count, 1);
        break;
      case Op::StoreLocal: locals[x.index] = *--top; break;
      case Op::StoreGlobal: instance_->globals[static_cast<std::size_t>(x.index)] = *--top; break;
      case Op::StoreElement:
        top -= x.count;
        instance_->elements[elementAt(x, top)] = top[-1];
        --top;
        break;
      case Op::Drop: --top; break;
      case Op::Jump: at = x.index - 1; break;
      case Op::JumpIfZero:
        if (*--top == 0) at = x.index - 1;
        break;
      case Op::LoopBack:
        if (!mayLoop(loops)) return 0;
        at = x.index - 1;
        break;
    }
    if (trouble_) return 0;
  }
  return top == stack_.data() ? 0 : top[-1];
}

}  // namespace axil::simeco
