#pragma once
/// \file
/// Derived: what follows from a project (document/chain.hpp), kept as long as its inputs stay the same. Asking again costs next to
/// nothing; changing a leaf does not solve the cameras anew. Each answer keeps the last good value beside the trouble of the present
/// project, so that a window can go on showing it, dimmed.
///
/// Not for several threads at once: whoever works in the background has a Derived and a snapshot of its own.

#include "document/chain.hpp"
#include "document/traits.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axil::document {

/// A derived value: the last that could be made, and why there is none for the project as it is now.
template <class T>
struct Shown {
  std::shared_ptr<const T> good;   ///< null: there has not been one yet
  std::optional<Error> trouble;    ///< empty: `good` is of the present project
  [[nodiscard]] bool isCurrent() const { return good != nullptr && !trouble; }
};

/// A view whose photo cannot be used now; its clicks still count.
struct PhotoTrouble {
  std::string view;
  std::filesystem::path photo;
  Error error;
};

/// One derived value and what it was made of.
template <class Inputs, class T>
class Memo {
 public:
  /// `make` gives a Result<T> and is called only where `inputs` are not those of last time.
  template <class Make>
  const Shown<T>& of(Inputs inputs, Make make) {
    if (inputs_ && *inputs_ == inputs) return shown_;
    ++made_;
    auto result = make();
    inputs_ = std::move(inputs);
    if (result) shown_.good = std::make_shared<const T>(std::move(*result));
    shown_.trouble = result ? std::nullopt : std::optional(result.error());
    return shown_;
  }
  /// What it would be made of has no answer itself.
  const Shown<T>& without(const Error& trouble) {
    inputs_.reset();
    shown_.trouble = trouble;
    return shown_;
  }
  [[nodiscard]] std::size_t timesMade() const { return made_; }

 private:
  std::optional<Inputs> inputs_;
  Shown<T> shown_;
  std::size_t made_ = 0;
};

class Derived {
 public:
  explicit Derived(ChainOptions options = {}) : options_(std::move(options)) {}

  /// The facts the project goes by.
  [[nodiscard]] const Shown<keywords::Traits>& traits(const Project& project);
  /// Cameras and usable clicks. A photo that is missing or unreadable is no trouble here: see `photoTroubles`.
  [[nodiscard]] const Shown<Measured>& measured(const OpenProject& open);
  [[nodiscard]] const Shown<skeleton3d::Skeleton>& skeleton(const OpenProject& open);
  [[nodiscard]] const Shown<quantify::Measurements>& measurements(const OpenProject& open);
  [[nodiscard]] const Shown<simeco::Grammar>& grammar(const OpenProject& open, GrammarKind kind);
  [[nodiscard]] const Shown<std::string>& grammarText(const OpenProject& open, GrammarKind kind);

  /// Photos that cannot be used, as of now: files that appear or change on disk are noticed at each call.
  [[nodiscard]] std::vector<PhotoTrouble> photoTroubles(const OpenProject& open);
  /// How often cameras and skeletons were worked out, for tests and benchmarks.
  [[nodiscard]] std::size_t timesMeasured() const { return measured_.timesMade(); }
  [[nodiscard]] std::size_t timesSolved() const { return skeleton_.timesMade(); }

 private:
  /// A file as it was when it was looked at; `seconds` and `bytes` are 0 where there is none.
  struct FileStamp {
    std::filesystem::file_time_type changed;
    std::uintmax_t bytes = 0;
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
  };
  struct Probe {
    FileStamp stamp;
    Result<skeleton3d::PhotoInfo> info;
  };
  struct TraitInputs {
    SharedText description;
    SharedList<ProjectTrait> decisions;
    friend bool operator==(const TraitInputs&, const TraitInputs&) = default;
  };
  struct MeasuredInputs {
    SharedList<ProjectView> views;
    SharedList<ProjectNode> nodes;
    SharedList<ProjectStem> stems;  // they decide between clicks that could be wrong
    std::vector<FileStamp> photos;
    friend bool operator==(const MeasuredInputs&, const MeasuredInputs&) = default;
  };
  struct SkeletonInputs {
    std::shared_ptr<const Measured> measured;
    TraitInputs traits;
    SharedList<ProjectStem> stems;
    SharedList<ProjectLeaves> leaves;
    std::string unit;
    friend bool operator==(const SkeletonInputs&, const SkeletonInputs&) = default;
  };
  struct GrammarInputs {
    std::shared_ptr<const quantify::Measurements> measurements;
    std::string name;
    std::uint64_t seed = 0;
    friend bool operator==(const GrammarInputs&, const GrammarInputs&) = default;
  };

  static FileStamp stampOf(const std::filesystem::path& file);
  const Probe& probe(const std::filesystem::path& photo);

  ChainOptions options_;
  std::map<std::filesystem::path, Probe> probes_;
  Memo<TraitInputs, keywords::Traits> traits_;
  Memo<MeasuredInputs, Measured> measured_;
  Memo<SkeletonInputs, skeleton3d::Skeleton> skeleton_;
  Memo<std::shared_ptr<const skeleton3d::Skeleton>, quantify::Measurements> measurements_;
  std::map<GrammarKind, Memo<GrammarInputs, simeco::Grammar>> grammars_;
  std::map<GrammarKind, Memo<std::shared_ptr<const simeco::Grammar>, std::string>> texts_;
};

}  // namespace axil::document
