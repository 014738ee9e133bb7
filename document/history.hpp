#pragma once
/// \file
/// History: every state of a project that a user has been in, beside the step that led to it. `run` is the one door through which
/// a project changes. Undo and redo move between states and cost nothing; there is no limit but memory, and states share what they
/// have in common (10,000 steps on a plant of 500 segments stay below 50 MB).

#include "document/command.hpp"

#include <memory>
#include <vector>

namespace axil::document {

class History {
 public:
  struct Entry {
    Step step;                             ///< empty for the first entry: the project as it was given
    std::shared_ptr<const Project> after;  ///< never null
  };

  explicit History(Project initial);

  [[nodiscard]] const Project& project() const { return *entries_[position_].after; }
  /// The same, for whoever goes on with it while the history moves.
  [[nodiscard]] std::shared_ptr<const Project> snapshot() const { return entries_[position_].after; }

  /// Goes one step on and forgets what was undone. Fails as `apply` does and leaves no trace. A step that changes nothing is not kept.
  enum class Ran { Changed, Unchanged };
  [[nodiscard]] Result<Ran> run(Step step);
  [[nodiscard]] Result<Ran> run(const Command& command) { return run(Step{command}); }

  /// Fail with BadInput where there are not as many steps; nothing moves then.
  [[nodiscard]] Result<void> undo(std::size_t steps = 1);
  [[nodiscard]] Result<void> redo(std::size_t steps = 1);
  /// To a place in `entries()`.
  [[nodiscard]] Result<void> goTo(std::size_t position);

  /// The whole list for a panel: entries behind `position()` are those that redo brings back.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] bool canUndo() const { return position_ > 0; }
  [[nodiscard]] bool canRedo() const { return position_ + 1 < entries_.size(); }

 private:
  std::vector<Entry> entries_;
  std::size_t position_ = 0;
};

}  // namespace axil::document
