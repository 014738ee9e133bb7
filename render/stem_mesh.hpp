#pragma once
/// \file
/// Private to render: pieces of one mesh that were made apart from each other.

#include "render/types.hpp"

namespace axil::render {

/// All pieces as one mesh, in their order. Their memory is given back as they are taken over.
[[nodiscard]] StemMesh joined(std::vector<StemMesh> pieces);

}  // namespace axil::render
