#include "ui/export_file.hpp"

#include "base/files.hpp"
#include "base/units.hpp"
#include "emit/dialects.hpp"
#include "render/animation.hpp"
#include "render/mesh_files.hpp"
#include "render/picture.hpp"
#include "simeco/language.hpp"

#include <map>

namespace axil::ui {
namespace {

namespace fs = std::filesystem;

constexpr int kVideoFrames = 120;

Result<render::PlantMesh> meshNow(const FileQuestion& question) {
  if (!question.growth) return fail(ErrorCode::NoAnswer, "there is no plant to write yet");
  const auto plant = simeco::plantAt(*question.growth, question.time);
  if (!plant) return plant.failure();
  return render::meshOf(*plant);
}

render::PictureOptions lookOf(const FileQuestion& question) {
  return {.width_px = question.size_px.x / 2 * 2, .height_px = question.size_px.y / 2 * 2, .view = question.camera};
}

Result<void> writePicture(const FileQuestion& question) {
  const auto mesh = meshNow(question);
  if (!mesh) return mesh.failure();
  const auto image = render::drawPlant(*mesh, lookOf(question));
  return image ? render::writePng(question.file, *image) : image.failure();
}

Result<void> writeVideo(const FileQuestion& question) {
  if (!question.growth) return fail(ErrorCode::NoAnswer, "there is no plant to film yet");
  render::AnimationOptions animation{.from = 0, .to = question.end, .frames = kVideoFrames};
  animation.picture = lookOf(question);
  return render::writeAnimation(question.file, [&](double time) { return simeco::plantAt(*question.growth, time); }, animation);
}

Result<void> writeGlb(const FileQuestion& question) {
  const auto mesh = meshNow(question);
  return mesh ? render::writeGlb(*mesh, question.file, {.metresPerUnit = metresPer(question.unit).value_or(1)}) : mesh.failure();
}

Result<void> writePly(const FileQuestion& question) {
  const auto mesh = meshNow(question);
  return mesh ? writeFile(question.file, render::plyBytes(*mesh)) : mesh.failure();
}

Result<void> writeObj(const FileQuestion& question) {
  const auto mesh = meshNow(question);
  return mesh ? render::writeObj(*mesh, question.file) : mesh.failure();
}

Result<void> writeText(const FileQuestion& question) { return writeFile(question.file, question.text); }

Result<void> writeDialect(const FileQuestion& question, emit::Dialect dialect) {
  const simeco::Parsed parsed = simeco::parseSimeco(question.text);
  if (!parsed.ok()) return fail(ErrorCode::BadGrammar, "the grammar has errors; only its own text can be saved, as .simeco");
  const auto text = emit::inDialect(parsed.grammar, dialect);
  if (!text) return text.failure();
  if (!text->view.empty())
    if (auto written = writeFile(fs::path(question.file).replace_extension(".v"), text->view); !written) return written;
  if (!text->animation.empty())
    if (auto written = writeFile(fs::path(question.file).replace_extension(".a"), text->animation); !written) return written;
  return writeFile(question.file, text->text);
}

using Write = Result<void> (*)(const FileQuestion&);
const std::map<std::string, Write>& writers() {
  static const std::map<std::string, Write> kWriters = {
      {".png", writePicture}, {".mp4", writeVideo}, {".webm", writeVideo}, {".glb", writeGlb}, {".obj", writeObj}, {".ply", writePly}, {".simeco", writeText},
      {".l", [](const FileQuestion& q) { return writeDialect(q, emit::Dialect::Cpfg); }},
      {".lpy", [](const FileQuestion& q) { return writeDialect(q, emit::Dialect::LPy); }},
      {".mtg", [](const FileQuestion& q) { return writeDialect(q, emit::Dialect::Mtg); }}};
  return kWriters;
}

FileAnswer write(const FileQuestion& question) {
  const auto writer = writers().find(question.file.extension().string());
  if (writer == writers().end())
    return {question.file, fail(ErrorCode::BadInput, "cannot tell what to write from '" + question.file.filename().string() + "'; end it in .png, .mp4, .webm, .glb, .obj, .ply, .simeco, .l, .lpy or .mtg")};
  return {question.file, writer->second(question)};
}

}  // namespace

FileWriter::Work fileWork() { return write; }

bool canExport(const fs::path& file) { return writers().contains(file.extension().string()); }

}  // namespace axil::ui
