#pragma once
/// \file
/// The chain: from an open project to its skeleton, its numbers and its grammars. Each function does the steps before it,
/// so each can be asked alone; nothing is written to disk. Source: L-Grammar Generator 2005, chapter 3.

#include "base/progress.hpp"
#include "document/project.hpp"
#include "emit/emit.hpp"
#include "keywords/keywords.hpp"
#include "quantify/quantify.hpp"
#include "simeco/derive.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace axil::document {

/// Whether clicks go to the centre lines of the stems in the photos (skeleton3d/snap.hpp), which also measures widths.
enum class Snap { Off, On };

struct ChainOptions {
  skeleton3d::SolveOptions solve = {};
  TurningRule turning = TurningRule::Exact;
  int decimals = 6;  ///< of the numbers in a grammar; -1: full precision
  emit::PredictiveOptions predictive = {};
  emit::StructureOptions structure = {};
  simeco::Limits limits = {};  ///< of growing the grammars
  Watch watch = {};
  Snap snap = Snap::Off;
  /// How size and lens of a photo are found out; whoever asks often keeps the answers.
  std::function<Result<skeleton3d::PhotoInfo>(const std::filesystem::path&)> probePhoto = skeleton3d::probePhoto;
};

/// Where the view's photo is.
[[nodiscard]] std::filesystem::path photoPath(const OpenProject& open, const ProjectView& view);

enum class GrammarKind { Initial, Predictive, Structured };
[[nodiscard]] const char* nameOf(GrammarKind kind);

/// What the project's description and the user's decisions about it set.
[[nodiscard]] Result<keywords::Presets> presetsOf(const Project& project);

/// What the measuring room starts from: every photo that is named is there, is a photo and has the size the file says;
/// every camera is known, or has been estimated from the clicks. Clicks that cannot be right are named and left out.
struct Measured {
  std::vector<skeleton3d::View> views;
  std::vector<skeleton3d::ClickedNode> nodes;
  std::vector<skeleton3d::CameraReport> cameras;    ///< of the estimated ones
  std::vector<skeleton3d::SuspectClick> suspects;
  skeleton3d::Uncertainty uncertainty = {};         ///< of the nodes, from the scatter of their clicks and the cameras
  std::vector<std::string> notes = {};              ///< what a person should look at
  std::vector<skeleton3d::SnappedNode> snapped = {};  ///< with Snap::On
};
[[nodiscard]] Result<Measured> measured(const OpenProject& open, const ChainOptions& options);

[[nodiscard]] Result<skeleton3d::Skeleton> skeletonOf(const OpenProject& open, const ChainOptions& options);
[[nodiscard]] Result<skeleton3d::Skeleton> skeletonOf(const Project& project, const Measured& clicks, const ChainOptions& options);
[[nodiscard]] Result<quantify::Measurements> measurementsOf(const OpenProject& open, const ChainOptions& options);
[[nodiscard]] Result<quantify::Measurements> measurementsOf(const skeleton3d::Skeleton& skeleton, const ChainOptions& options);
[[nodiscard]] Result<simeco::Grammar> grammarOf(const OpenProject& open, GrammarKind kind, const ChainOptions& options);
[[nodiscard]] Result<simeco::Grammar> grammarOf(const Project& project, const quantify::Measurements& measurements, GrammarKind kind,
                                                const ChainOptions& options);

}  // namespace axil::document
