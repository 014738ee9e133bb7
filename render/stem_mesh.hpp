#pragma once
/// \file
/// Private to render: how a StemMesh is made by many threads at once.

#include "render/types.hpp"

namespace axil::render {

/// So many vertices and triangles, none of them written yet: who asks for room fills all of it. Pages are touched first by the
/// thread that fills them.
[[nodiscard]] StemMesh roomFor(std::size_t vertices, std::size_t triangles);

}  // namespace axil::render
