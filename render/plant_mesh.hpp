#pragma once
/// \file
/// A grown plant as triangles: stems become smooth tubes, leaves, flowers and fruits become placed copies of a few models.
///
/// Every triangle and every copy names its organ. Colours are the styles' own, brought to what plants have (colour.hpp);
/// thick stems go over to bark. A model name that is not known is drawn as its kind's default and said in `notes`.

#include "base/result.hpp"
#include "render/types.hpp"

#include <optional>

namespace axil::render {

struct MeshOptions {
  std::optional<organs::Detail> detail;           ///< none: by the number of organs, so that a picture stays quick
  std::size_t maximumTriangles = 40'000'000;      ///< with every copy counted; about 2 GB when flattened
};

/// The level of detail that `meshOf` takes for a plant of so many organs when asked for none.
[[nodiscard]] organs::Detail detailFor(std::size_t organCount);

/// The plant's triangles. A plant of nothing but growing points gives an empty mesh. Fails with LimitReached above
/// `maximumTriangles`, with BadInput where an organ's place or size is not a finite number (the organ is named).
[[nodiscard]] Result<PlantMesh> meshOf(const simeco::Plant& plant, const MeshOptions& options = {});

}  // namespace axil::render
