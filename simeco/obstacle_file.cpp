// Meshes from .obj text: `v x y z` are points, `f` faces of three corners or more, each a point's number, behind which a slash may say
// what else belongs to the corner. All other lines say how a mesh looks and are passed over.

#include "base/text.hpp"
#include "simeco/environment.hpp"

#include <cmath>
#include <string>

namespace axil::simeco {

namespace {

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

Failure bad(std::size_t line, const std::string& what) { return fail(ErrorCode::BadInput, "line " + std::to_string(line) + ": " + what); }

Result<PlantPoint> pointOf(const std::vector<std::string_view>& words, std::size_t line) {
  if (words.size() < 4) return bad(line, "a point needs three numbers: v x y z");
  PlantPoint point;
  for (int i = 0; i < 3; ++i) {
    const auto number = parseNumber(words[static_cast<std::size_t>(i) + 1]);
    if (!number || !std::isfinite(*number)) return bad(line, "'" + std::string(words[static_cast<std::size_t>(i) + 1]) + "' is not a number");
    point.at[i] = *number;
  }
  return point;
}

/// Counted from 1, or backwards from the last point so far.
Result<std::uint32_t> cornerOf(std::string_view word, std::size_t points, std::size_t line) {
  const auto number = parseNumber(word.substr(0, word.find('/')));
  const double last = static_cast<double>(points);
  if (!number || *number != std::trunc(*number)) return bad(line, "a corner is the number of a point, not '" + std::string(word) + "'");
  const double place = *number < 0 ? last + *number : *number - 1;
  if (!(place >= 0 && place < last)) return bad(line, "there is no point number " + std::string(word) + " before this line");
  return static_cast<std::uint32_t>(place);
}

/// A face of many corners is a fan of triangles.
Result<void> addFace(MeshObstacle& mesh, const std::vector<std::string_view>& words, std::size_t line) {
  if (words.size() < 4) return bad(line, "a face needs three corners or more: f a b c");
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto corner = cornerOf(words[i], mesh.points.size(), line);
    if (!corner) return corner.failure();
    corners.push_back(*corner);
  }
  for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  if (mesh.triangles.size() <= kMostObstacleTriangles) return {};
  return fail(ErrorCode::LimitReached, "the mesh has more than " + std::to_string(kMostObstacleTriangles) + " triangles; give a coarser one");
}

}  // namespace

Result<MeshObstacle> obstacleFromObj(std::string_view text) {
  MeshObstacle mesh;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string_view> words = wordsOf(text.substr(at, end - at));
    at = end + 1;
    ++line;
    if (words.empty()) continue;
    if (words[0] == "v") {
      const auto point = pointOf(words, line);
      if (!point) return point.failure();
      mesh.points.push_back(*point);
    }
    if (words[0] == "f")
      if (auto added = addFace(mesh, words, line); !added) return added.failure();
  }
  if (mesh.triangles.empty()) return fail(ErrorCode::NoAnswer, "there is no face in it (a mesh is given as .obj text: lines v x y z and f a b c)");
  return mesh;
}

}  // namespace axil::simeco
