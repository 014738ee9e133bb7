#pragma once
/// \file
/// Mesh files: a plant for other programs, as bytes or straight into a file (which holds no second copy of a large plant). The same plant
/// gives the same bytes on every machine.
///
/// glTF 2.0 (.glb): metres, Y up, linear PBR factors; stems carry a vertex colour; leaves share one mesh a model, a node
/// each, named after model and organ ("leaf ovate 57"). OBJ with MTL: a group an organ. PLY: binary little endian, vertex
/// colours in sRGB, and the organ's number on each face.

#include "base/result.hpp"
#include "render/types.hpp"

#include <filesystem>
#include <string>

namespace axil::render {

/// Shared: a node a leaf, small files. Merged: all copies of a model as one mesh, for viewers that are slow with many
/// nodes. Auto: Shared up to `sharedUpTo` leaves.
enum class ModelStorage { Auto, Shared, Merged };
inline constexpr std::size_t sharedUpTo = 4000;

struct GlbOptions {
  ModelStorage storage = ModelStorage::Auto;
  double metresPerUnit = 1;
};

/// Fails with LimitReached above 4 GB, which the format cannot hold, and with BadInput for a `metresPerUnit` not above 0.
[[nodiscard]] Result<std::string> glbBytes(const PlantMesh& mesh, const GlbOptions& options = {});
/// As `glbBytes`, and with Unwritable.
[[nodiscard]] Result<void> writeGlb(const PlantMesh& mesh, const std::filesystem::path& file, const GlbOptions& options = {});

struct ObjFiles {
  std::string obj;
  std::string mtl;
};
/// `mtlName` is the file name under which the caller writes `mtl` beside the OBJ; a name without blanks or line ends.
[[nodiscard]] Result<ObjFiles> objAndMtl(const PlantMesh& mesh, const std::string& mtlName);
/// Writes the .obj and its .mtl beside it, which has the same name (with `_` for blanks, which an OBJ cannot name).
[[nodiscard]] Result<void> writeObj(const PlantMesh& mesh, const std::filesystem::path& file);

[[nodiscard]] std::string plyBytes(const PlantMesh& mesh);

}  // namespace axil::render
