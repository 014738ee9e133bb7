#pragma once
/// \file
/// Expressions that rules of a predictive grammar are made of: numbers to the plan's digits, what varies by chance, and lengths carried on along their order's course (quantify/outlook.hpp). Private to this room.

#include "emit/assembly.hpp"
#include "emit/builder.hpp"
#include "emit/plan.hpp"
#include "quantify/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace axil::emit {

/// Owns the grammar that is being written.
class PredictiveExpressions {
 protected:
  /// `lastStage`: of the plant, when all that is foretold has grown.
  PredictiveExpressions(Assembled initial, const Digits& digits, double lastStage) : out_(std::move(initial)), builder_(out_.grammar), digits_(digits), lastStage_(lastStage) {}

  simeco::ExprId angle(double radians) { return builder_.number(rounded(radians, digits_.angle) + 0.0, digits_.angle); }
  simeco::ExprId size(double length) { return builder_.number(length, digits_.length); }
  simeco::ExprId ratio(double value) { return builder_.number(value, 4); }
  simeco::ExprId name(const char* text) { return builder_.name(text); }
  simeco::ExprId plus(simeco::ExprId a, simeco::ExprId b) { return builder_.binary(simeco::BinaryOp::Add, a, b); }
  simeco::ExprId minus(simeco::ExprId a, simeco::ExprId b) { return builder_.binary(simeco::BinaryOp::Subtract, a, b); }
  simeco::ExprId times(simeco::ExprId a, simeco::ExprId b) { return builder_.binary(simeco::BinaryOp::Multiply, a, b); }
  simeco::ExprId anySide() { return builder_.call("random", {angle(-std::numbers::pi), angle(std::numbers::pi)}); }
  simeco::ExprId drawnAngle(double mean, double deviation) {
    if (rounded(deviation, digits_.angle) == 0) return angle(mean);
    return builder_.call("normal", {angle(mean), angle(deviation)});
  }
  simeco::ExprId scaled(simeco::ExprId length, double factor) { return std::abs(factor - 1) < 5e-5 ? length : times(length, ratio(factor)); }
  /// exp(factor * of)
  simeco::ExprId exponential(double factor, simeco::ExprId of) { return builder_.call("exp", {times(builder_.number(factor, 6), of)}); }
  /// What a bow is made of at `place`: exp(-pace * (place - middle)), and 1 more or 1 less that.
  simeco::ExprId bowTerm(const quantify::Bow& bow, simeco::ExprId place) {
    return exponential(-bow.pace, bow.middle < 0 ? plus(place, builder_.number(-bow.middle, 4)) : minus(place, builder_.number(bow.middle, 4)));
  }
  simeco::ExprId bowSum(const quantify::Bow& bow, simeco::ExprId place) {
    if (bow.sign > 0) return plus(builder_.whole(1), bowTerm(bow, place));
    return builder_.call("max", {builder_.number(quantify::Bow::kLeast, 2), minus(builder_.whole(1), bowTerm(bow, place))});
  }
  /// A bow's value at `place` over that at `under`. Without quotients of what may be nothing.
  simeco::ExprId bowRatio(const quantify::Bow& bow, simeco::ExprId place, simeco::ExprId under) {
    if (bow.shape == quantify::Bow::Shape::Logistic) std::swap(place, under);
    if (bow.shape != quantify::Bow::Shape::Gompertz) return builder_.binary(simeco::BinaryOp::Divide, bowSum(bow, place), bowSum(bow, under));
    const simeco::ExprId more = bowTerm(bow, place), less = bowTerm(bow, under);
    return builder_.call("exp", {bow.sign > 0 ? minus(more, less) : minus(less, more)});
  }
  simeco::ExprId bowAt(const quantify::Bow& bow, simeco::ExprId place) {
    using Shape = quantify::Bow::Shape;
    switch (bow.shape) {
      case Shape::Mitscherlich: return bowSum(bow, place);
      case Shape::Logistic: return builder_.binary(simeco::BinaryOp::Divide, builder_.whole(1), bowSum(bow, place));
      case Shape::Gompertz: return exponential(bow.sign, bowTerm(bow, place));
    }
    return place;
  }
  /// `length` of the place `from` carried on to the next one.
  simeco::ExprId carriedOn(const quantify::OrderOutlook& o, simeco::ExprId length, simeco::ExprId from) {
    const auto& course = o.length;
    if (course.bow) return times(length, bowRatio(*course.bow, plus(from, builder_.whole(1)), from));
    const simeco::ExprId next = scaled(length, course.step);
    return course.curve == 1 ? next : times(next, exponential(std::log(course.curve), from));
  }
  /// And back from the next place to `from`.
  simeco::ExprId carriedBack(const quantify::OrderOutlook& o, simeco::ExprId length, double ratioToIt, simeco::ExprId from) {
    const auto& course = o.length;
    if (course.bow) return times(scaled(length, ratioToIt), bowRatio(*course.bow, from, plus(from, builder_.whole(1))));
    const simeco::ExprId below = scaled(length, ratioToIt / course.step);
    return course.curve == 1 ? below : times(below, exponential(-std::log(course.curve), from));
  }
  /// The usual first length of axes that begin in a stage of the plant.
  simeco::ExprId usualAt(const quantify::OrderOutlook& o, simeco::ExprId stage) {
    const auto& course = o.length;
    if (course.bow) return times(size(o.usualLength), bowAt(*course.bow, stage));
    const simeco::ExprId length = times(size(o.usualLength), exponential(std::log(course.step), stage));
    return course.curve == 1 ? length : times(length, exponential(std::log(course.curve) / 2, times(stage, minus(stage, builder_.whole(1)))));
  }
  /// Whether lengths may grow without end.
  static bool growsOn(const quantify::LengthOutlook& course) { return !course.bow && (course.step > 1 + 5e-5 || course.curve > 1); }
  /// The stage of the plant in which an apex makes what it makes next.
  simeco::ExprId stageNow() { return minus(builder_.number(lastStage_ + 1, 4), name("left")); }
  /// The place on its order's course, by rank or by the plant's stages, of the segment that is being made; `below` it.
  simeco::ExprId courseAt(const quantify::OrderOutlook& o, simeco::ExprId rank, int below) {
    if (o.length.along == quantify::LengthsAlong::Stage) return below == 0 ? stageNow() : minus(stageNow(), builder_.whole(below));
    return below == 0 ? rank : minus(rank, builder_.whole(below));
  }
  /// `length` with the order's chance around it.
  simeco::ExprId varied(simeco::ExprId length, double miss) {
    if (miss < 5e-5) return length;
    return times(length, builder_.call("exp", {builder_.call("normal", {builder_.whole(0), ratio(std::min(miss, 1.0))})}));
  }
  static void turn(std::vector<simeco::Module>& to, simeco::ExprId rotr, simeco::ExprId rotu) {
    to.push_back(Builder::module("rotr", {rotr}));
    to.push_back(Builder::module("rotu", {rotu}));
  }

  Assembled out_;
  Builder builder_;

 private:
  const Digits& digits_;
  double lastStage_;
};

}  // namespace axil::emit
