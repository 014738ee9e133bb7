#include "document/history.hpp"

#include <string>

namespace axil::document {

namespace {

Failure tooFew(std::size_t wanted, std::size_t there, const char* what) {
  if (there == 0) return fail(ErrorCode::BadInput, std::string("there is nothing to ") + what);
  return fail(ErrorCode::BadInput, "there are only " + std::to_string(there) + " steps to " + what + ", not " + std::to_string(wanted));
}

}  // namespace

History::History(Project initial) { entries_.push_back({{}, std::make_shared<const Project>(std::move(initial))}); }

Result<History::Ran> History::run(Step step) {
  auto next = document::apply(project(), step);
  if (!next) return next.failure();
  if (*next == project()) return Ran::Unchanged;
  entries_.resize(position_ + 1);
  step.shrink_to_fit();
  entries_.push_back({std::move(step), std::make_shared<const Project>(std::move(*next))});
  ++position_;
  return Ran::Changed;
}

Result<void> History::undo(std::size_t steps) {
  if (steps > position_) return tooFew(steps, position_, "undo");
  position_ -= steps;
  return {};
}

Result<void> History::redo(std::size_t steps) {
  const std::size_t there = entries_.size() - 1 - position_;
  if (steps > there) return tooFew(steps, there, "redo");
  position_ += steps;
  return {};
}

Result<void> History::goTo(std::size_t position) {
  if (position >= entries_.size())
    return fail(ErrorCode::BadInput, "the history has places 0 to " + std::to_string(entries_.size() - 1) + ", not " + std::to_string(position));
  position_ = position;
  return {};
}

}  // namespace axil::document
