#include "render/stem_mesh.hpp"

#include "render/parallel.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace axil::render {
namespace {

/// Appends one array of every piece and gives its memory back.
template <class T>
void take(std::vector<T>& whole, std::vector<StemMesh>& pieces, std::vector<T> StemMesh::*array) {
  std::size_t size = 0;
  for (const StemMesh& piece : pieces) size += (piece.*array).size();
  whole.reserve(size);
  for (StemMesh& piece : pieces) {
    whole.insert(whole.end(), (piece.*array).begin(), (piece.*array).end());
    piece.*array = {};
  }
}

/// The triangles count vertices from the first of their piece.
void takeTriangles(std::vector<std::uint32_t>& whole, std::vector<StemMesh>& pieces, const std::vector<std::uint32_t>& firsts) {
  std::size_t size = 0;
  for (const StemMesh& piece : pieces) size += piece.triangles.size();
  whole.reserve(size);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (const std::uint32_t vertex : pieces[k].triangles) whole.push_back(firsts[k] + vertex);
    pieces[k].triangles = {};
  }
}

}  // namespace

StemMesh joined(std::vector<StemMesh> pieces) {
  if (pieces.size() == 1) return std::move(pieces.front());
  StemMesh whole;
  std::vector<std::uint32_t> firsts;
  std::uint32_t vertices = 0;
  for (const StemMesh& piece : pieces) {
    firsts.push_back(vertices);
    vertices += static_cast<std::uint32_t>(piece.positions.size());
  }
  const std::array<std::function<void()>, 5> arrays{[&] { takeTriangles(whole.triangles, pieces, firsts); },
                                                    [&] { take(whole.positions, pieces, &StemMesh::positions); },
                                                    [&] { take(whole.normals, pieces, &StemMesh::normals); },
                                                    [&] { take(whole.colours, pieces, &StemMesh::colours); },
                                                    [&] { take(whole.sources, pieces, &StemMesh::sources); }};
  inParallel(arrays.size(), [&](std::size_t k) { arrays[k](); });
  return whole;
}

}  // namespace axil::render
