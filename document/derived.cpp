#include "document/derived.hpp"

#include "simeco/simeco.hpp"

namespace axil::document {

namespace fs = std::filesystem;

Derived::FileStamp Derived::stampOf(const fs::path& file) {
  std::error_code code;
  const auto changed = fs::last_write_time(file, code);
  if (code) return {};
  const std::uintmax_t bytes = fs::file_size(file, code);
  return {changed, code ? 0 : bytes};
}

const Derived::Probe& Derived::probe(const fs::path& photo) {
  const FileStamp stamp = stampOf(photo);
  const auto known = probes_.find(photo);
  if (known != probes_.end() && known->second.stamp == stamp) return known->second;
  return probes_.insert_or_assign(photo, Probe{stamp, options_.probePhoto(photo)}).first->second;
}

std::vector<PhotoTrouble> Derived::photoTroubles(const OpenProject& open) {
  std::vector<PhotoTrouble> troubles;
  for (const ProjectView& view : open.project.views) {
    if (view.photo.empty()) continue;
    const fs::path photo = photoPath(open, view);
    if (const Probe& probed = probe(photo); !probed.info) troubles.push_back({view.view.name, photo, probed.info.error()});
  }
  return troubles;
}

const Shown<keywords::Traits>& Derived::traits(const Project& project) {
  return traits_.of({project.description, project.traits}, [&] { return traitsOf(project); });
}

const Shown<Measured>& Derived::measured(const OpenProject& open) {
  MeasuredInputs inputs{open.project.views, open.project.nodes, open.project.stems, {}};
  OpenProject usable = open;
  for (std::size_t i = 0; i < open.project.views.size(); ++i) {
    ProjectView view = open.project.views[i];
    if (view.photo.empty()) continue;
    const Probe& probed = probe(photoPath(open, view));
    inputs.photos.push_back(probed.stamp);
    if (probed.info) continue;
    view.photo.clear();
    usable.project.views.set(i, std::move(view));
  }
  return measured_.of(std::move(inputs), [&] {
    ChainOptions options = options_;
    options.probePhoto = [this](const fs::path& photo) { return probe(photo).info; };
    return document::measured(usable, options);
  });
}

const Shown<skeleton3d::Skeleton>& Derived::skeleton(const OpenProject& open) {
  const Shown<Measured>& clicks = measured(open);
  if (clicks.trouble) return skeleton_.without(*clicks.trouble);
  const Project& project = open.project;
  return skeleton_.of({clicks.good, {project.description, project.traits}, project.stems, project.leaves, project.unit},
                      [&] { return skeletonOf(project, *clicks.good, options_); });
}

const Shown<quantify::Measurements>& Derived::measurements(const OpenProject& open) {
  const Shown<skeleton3d::Skeleton>& tree = skeleton(open);
  if (tree.trouble) return measurements_.without(*tree.trouble);
  return measurements_.of(tree.good, [&] { return measurementsOf(*tree.good, options_); });
}

const Shown<simeco::Grammar>& Derived::grammar(const OpenProject& open, GrammarKind kind) {
  const Shown<quantify::Measurements>& numbers = measurements(open);
  if (numbers.trouble) return grammars_[kind].without(*numbers.trouble);
  return grammars_[kind].of({numbers.good, open.project.name, open.project.seed}, [&] { return grammarOf(open.project, *numbers.good, kind, options_); });
}

const Shown<std::string>& Derived::grammarText(const OpenProject& open, GrammarKind kind) {
  const Shown<simeco::Grammar>& made = grammar(open, kind);
  if (made.trouble) return texts_[kind].without(*made.trouble);
  return texts_[kind].of(made.good, [&] { return Result<std::string>(simeco::print(*made.good)); });
}

}  // namespace axil::document
