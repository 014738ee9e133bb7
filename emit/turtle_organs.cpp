#include "emit/turtle_writer.hpp"

namespace axil::emit::turtle {

ProgramWriter::Angle ProgramWriter::sum(const std::vector<ExprId>& parts) {
  Angle all{"", 0.0};
  for (const ExprId part : parts) {
    const auto value = writer_.constant(part);
    all.constant = all.constant && value ? std::optional(*all.constant + *value) : std::nullopt;
    const std::string own = writer_.text(part);
    all.text = all.text.empty() ? own : "(" + all.text + " + " + own + ")";
  }
  return all;
}

std::string ProgramWriter::degrees(const Angle& angle, double sign) {
  return angle.constant ? turtleNumber(*angle.constant * kDegrees * sign) : angle.text + "*" + turtleNumber(kDegrees * sign);
}

std::string ProgramWriter::branchRoll(const Angle& rotr) const {
  if (rotr.constant) return isStraight(rotr) ? "" : command("/", turtleNumber(std::copysign(90, rollSign() * std::sin(*rotr.constant))));
  const std::string sine = language_ == TurtleLanguage::Cpfg ? "sin(" + rotr.text + "*" + turtleNumber(kDegrees) + ")" : "sin(" + rotr.text + ")";
  const std::string straight = (language_ == TurtleLanguage::Cpfg ? "fabs(" : "abs(") + sine + ") < " + turtleNumber(kParallel);
  return command("/", language_ == TurtleLanguage::Cpfg ? "(" + straight + " ? 0 : -90*sign(" + sine + "))" : "(0 if " + straight + " else 90*sign(" + sine + "))");
}

std::string ProgramWriter::turn(Walk& walk, bool toLeaf) {
  Angle rotr = sum(walk.rotr);
  const Angle rotu = sum(walk.rotu);
  walk.rotr.clear();
  walk.rotu.clear();
  const bool isName = rotr.text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
  if (!rotr.constant && walk.branchAhead && !toLeaf && !isName) rotr.text = writer_.named(rotr.text);
  std::string text = roll(rotu) + pitch(rotr);
  if (toLeaf) {
    // The blade lies across its upper side: in the turtle's plane of turning once the leaf has bent away; else as its bearer's upper side.
    if (isStraight(rotr) && walk.adaxialIsAxis) text += command("/", turtleNumber(-90 * rollSign()));
    return text;
  }
  if (walk.branchAhead) text += branchRoll(rotr);
  walk.adaxialIsAxis = walk.branchAhead ? !isStraight(rotr) : walk.adaxialIsAxis && isStraight(rotr);
  return text;
}

std::optional<double> ProgramWriter::literal(const Grammar& g, const Module& m) {
  if (m.arguments.empty()) return {};
  const auto* number = std::get_if<simeco::Number>(&g.at(m.arguments[0]).node);
  return number == nullptr ? std::nullopt : std::optional(number->value);
}

bool ProgramWriter::beginsWithTurn(const simeco::Successor& s) {
  int depth = 0;
  for (const Module& m : s.modules) {
    if (m.letter == "[") ++depth;
    else if (m.letter == "]") --depth;
    else if (depth == 0) return m.letter == "rotr" || m.letter == "rotu";
  }
  return false;
}

void ProgramWriter::indexRules() {
  for (std::size_t i = 0; i < rules_.productions.size(); ++i) {
    const Production& p = rules_.productions[i];
    for (const std::vector<Module>* side : {&p.left, &p.predecessor, &p.right})
      for (const Module& m : *side) asked_.add(m, *this);
    if (!p.predecessor.empty() && std::any_of(p.successors.begin(), p.successors.end(), beginsWithTurn)) turning_.add(p.predecessor.front(), *this);
  }
}

const Body* ProgramWriter::bodyOf(const Module& m) const {
  const auto number = m.arguments.empty() ? std::nullopt : writer_.constant(m.arguments[0]);
  if (!number) return nullptr;
  const auto found = bodies_.find({m.letter, static_cast<int>(*number)});
  return found == bodies_.end() ? nullptr : &found->second;
}

ProgramWriter::Angle ProgramWriter::product(const Body& body, const char* rate, const char* time, double factor, const Meanings& meanings) {
  const Attribute* r = body.attribute(rate);
  if (r == nullptr) return {"0", 0.0};
  const Attribute* t = body.attribute(time);
  if (t == nullptr) t = body.attribute("GrowTime");
  const auto rateValue = writer_.constant(r->value);
  const auto timeValue = t == nullptr ? std::optional(1.0) : writer_.constant(t->value);
  if (rateValue && timeValue) return {"", *rateValue * *timeValue * factor};
  std::string text = writer_.text(r->value, meanings);
  if (!timeValue) text += "*" + writer_.text(t->value, meanings);
  const double rest = factor * timeValue.value_or(1);
  if (rest != 1) text += "*" + turtleNumber(rest);
  return {text, std::nullopt};
}

std::string ProgramWriter::width(const Body& body, const Meanings& meanings) {
  if (body.attribute("BroadenRate") == nullptr) return {};
  const double factor = simeco::modelRadius * (language_ == TurtleLanguage::Cpfg ? 2 : 1);
  return command(language_ == TurtleLanguage::Cpfg ? "!" : "_", numberOf(product(body, "BroadenRate", "BroadenTime", factor, meanings)));
}

std::string ProgramWriter::blade(const Body& body, const Meanings& meanings) {
  const Angle length = product(body, "GrowRate", "GrowTime", 1, meanings);
  Angle half = product(body, "BroadenRate", "BroadenTime", simeco::modelRadius, meanings);
  if (half.constant == 0.0) half = length.constant ? Angle{"", *length.constant / 4} : Angle{length.text + "/4", std::nullopt};
  // A turtle notes the corner where it starts only when it is told to.
  const std::string start = language_ == TurtleLanguage::Cpfg ? ";(2){." : ",(2){.";
  if (length.constant && half.constant) {
    const double side = std::hypot(*length.constant / 2, *half.constant);
    const double angle = std::atan2(*half.constant, *length.constant / 2) * kDegrees;
    const std::string edge = command("f", turtleNumber(side));
    return start + command("+", turtleNumber(angle)) + edge + command("-", turtleNumber(2 * angle)) + edge + command("-", turtleNumber(180 - 2 * angle)) + edge + "}";
  }
  const std::string l = writer_.named(numberOf(length));
  const std::string h = writer_.named(numberOf(half));
  const std::string side = writer_.named("sqrt(" + l + "*" + l + "/4 + " + h + "*" + h + ")");
  // acos of a ratio of lengths, since one of the languages has no atan2 that can be called.
  const std::string angle = writer_.named(language_ == TurtleLanguage::Cpfg ? "acos(" + l + "/(2*" + side + "))"
                                                                           : "acos(" + l + "/(2*" + side + "))*" + turtleNumber(kDegrees));
  const std::string edge = command("f", side);
  return start + command("+", angle) + edge + command("-", "2*" + angle) + edge + command("-", "180 - 2*" + angle) + edge + "}";
}

std::string ProgramWriter::organ(const Module& m, Walk& walk) {
  const bool leaf = m.letter == "L";
  const Body* body = bodyOf(m);
  const bool turned = !walk.rotr.empty() || !walk.rotu.empty();
  if (body == nullptr && (turned || walk.branchAhead) && beginsTurning(m)) troubles_.push_back("a turn before " + m.letter + " goes on in the rule of that module");
  if (body == nullptr && !m.arguments.empty() && !writer_.constant(m.arguments[0]) && hasBodies(m.letter) && !isCounter(m))
    troubles_.push_back("the stage of a module " + m.letter + " is computed");
  std::string text = turned || (leaf && body != nullptr) ? turn(walk, leaf && body != nullptr) : "";
  std::vector<std::string> arguments;
  for (const ExprId argument : m.arguments) arguments.push_back(writer_.text(argument));
  if (body != nullptr) {
    Meanings meanings;
    for (std::size_t i = 0; i < body->stage->parameters.size() && i + 1 < arguments.size(); ++i) meanings[body->stage->parameters[i]] = arguments[i + 1];
    text += leaf ? blade(*body, meanings) : width(*body, meanings) + command("F", numberOf(product(*body, "GrowRate", "GrowTime", 1, meanings)));
    walk.branchAhead = false;
  }
  if (body != nullptr && !isUsed(m)) return text;
  text += letterFor(m.letter);
  for (std::size_t i = 0; i < arguments.size(); ++i) text += (i == 0 ? "(" : ",") + arguments[i];
  return arguments.empty() ? text : text + ")";
}

bool ProgramWriter::hasBodies(const std::string& letter) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& entry) { return entry.first.first == letter; });
}

std::string ProgramWriter::modules(const std::vector<Module>& list) {
  std::string text;
  std::vector<Walk> outer;
  Walk walk;
  for (const Module& m : list) {
    if (m.letter == "[") {
      if (!walk.rotr.empty() || !walk.rotu.empty()) troubles_.emplace_back("a turn stands before a bracket");
      outer.push_back(walk);
      walk.branchAhead = true;
      text += "[";
    } else if (m.letter == "]") {
      if (!outer.empty()) walk = std::move(outer.back()), outer.pop_back();
      text += "]";
    } else if (m.letter == "rotr") {
      walk.rotr.push_back(m.arguments.at(0));
    } else if (m.letter == "rotu") {
      walk.rotu.push_back(m.arguments.at(0));
    } else if (simeco::organOfLetter(m.letter)) {
      text += organ(m, walk);
    } else {
      if (m.letter != "%") troubles_.push_back("it has the module " + m.letter);
      text += m.letter;
    }
  }
  return text;
}

std::string ProgramWriter::axiom() {
  std::string text;
  const auto vector = [&](const char* name, glm::dvec3 otherwise) {
    const Attribute* attribute = attributeIn(plant_.attributes, name);
    const auto* call = attribute == nullptr ? nullptr : std::get_if<simeco::Call>(&grammar_.at(attribute->value).node);
    if (call == nullptr || call->arguments.size() != 3) return otherwise;
    for (int k = 0; k < 3; ++k) otherwise[k] = writer_.constant(call->arguments[static_cast<std::size_t>(k)]).value_or(0);
    return otherwise;
  };
  const glm::dvec3 at = vector("Position", {0, 0, 0});
  const bool python = language_ == TurtleLanguage::LPy;
  if (at != glm::dvec3{0, 0, 0}) {
    const std::array<double, 3> place = python ? std::array{at.z, at.x, at.y} : std::array{at.x, at.y, at.z};
    text += "@M(" + turtleNumber(place[0]) + "," + turtleNumber(place[1]) + "," + turtleNumber(place[2]) + ")";
  }
  const StemFrame upright = firstFrame(PlantDirection::up());
  const StemFrame frame = firstFrame(PlantDirection::along(vector("Direction", {0, 1, 0})));
  const Turn turn = measuredTurn(upright, frame.direction);
  const double rest = signedAngleAbout(frame.direction, turned(upright.rAxis, upright.direction, turn.rotu), frame.rAxis).radians();
  text += roll({"", turn.rotu.radians()}) + pitch({"", turn.rotr.radians()});
  if (std::abs(rest) > kParallel) text += roll({"", rest});
  text += modules(rules_.axiom);
  axiomDraws_ = writer_.takeDraws();
  return text;
}

}  // namespace axil::emit::turtle
