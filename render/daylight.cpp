#include "render/daylight.hpp"

#include "render/parallel.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace axil::render {
namespace {

/// The sun's disc: half its opening, and how many directions stand for it.
constexpr double sunSpread = 0.085;
constexpr int sunDirections = 12, fewestSkyPairs = 10, mostSkyPairs = 28;
constexpr int sunPixels = 640, skyPixels = 256, groundCells = 320;
/// Triangles drawn in all, at most, before fewer directions are taken.
constexpr double triangleBudget = 12e6;
/// A point is in shadow when something lies more than this many pixels of the depth picture before it.
constexpr float biasPixels = 1.6f;
/// What the ground gets from the sun and from the sky, where nothing is in the way; they add up to 1.
constexpr float sunOnGround = 0.5f, skyOnGround = 0.5f;
/// Blurs of the sky's part of the ground's shade: what few directions leave as stripes goes.
constexpr int skyBlurs = 6;

struct Point {
  glm::vec3 at{0};
  glm::vec3 normal{0, 1, 0};
};

/// An orthographic view of everything, from far along `towards` (unit, to the light).
struct LightView {
  glm::vec3 towards{0, 1, 0};
  glm::vec3 right{1, 0, 0};
  glm::vec3 up{0, 0, 1};
  glm::vec3 centre{0};
  float scale = 1;   ///< pixels a unit of length
  int pixels = 1;

  [[nodiscard]] glm::vec3 pixelOf(const glm::vec3& p) const {
    const glm::vec3 d = p - centre;
    const float half = 0.5f * static_cast<float>(pixels);
    return {glm::dot(d, right) * scale + half, glm::dot(d, up) * scale + half, glm::dot(d, towards) * scale};
  }
};

LightView viewAlong(const glm::vec3& towards, const glm::vec3& centre, float radius, int pixels) {
  LightView view{.towards = towards, .right = {}, .up = {}, .centre = centre, .scale = 0.49f * static_cast<float>(pixels) / radius, .pixels = pixels};
  const glm::vec3 helper = std::abs(towards.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  view.right = glm::normalize(glm::cross(helper, towards));
  view.up = glm::cross(towards, view.right);
  return view;
}

/// The nearest surface to the light, and the furthest from it (the nearest to a light on the other side), in pixels.
struct DepthPicture {
  LightView view;
  std::vector<float> near_, far_;
  std::vector<glm::vec3> vertices;  ///< where the mesh's vertices are in the picture; kept, since memory costs time

  void draw(const FlatMesh& mesh);
  [[nodiscard]] bool reachedFromLight(const glm::vec3& pixel) const { return pixel.z + biasPixels >= depthAt(near_, pixel, -1e30f); }
  [[nodiscard]] bool reachedFromBehind(const glm::vec3& pixel) const { return pixel.z - biasPixels <= depthAt(far_, pixel, 1e30f); }

 private:
  void drawTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  [[nodiscard]] float depthAt(const std::vector<float>& depths, const glm::vec3& pixel, float outside) const {
    const int x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
    if (pixel.x < 0 || pixel.y < 0 || x >= view.pixels || y >= view.pixels) return outside;
    return depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.pixels) + static_cast<std::size_t>(x)];
  }
};

void DepthPicture::drawTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (std::abs(area) < 1e-6f) return;
  // Pixel centres within the triangle's box; the whole plant lies inside the picture, so nothing is below 0.
  const auto low = [](float p, float q, float r) { return static_cast<int>(std::min(std::min(p, q), r) + 0.5f); };
  const auto high = [](float p, float q, float r) { return static_cast<int>(std::max(std::max(p, q), r) + 0.5f) - 1; };
  const int x0 = low(a.x, b.x, c.x), x1 = std::min(high(a.x, b.x, c.x), view.pixels - 1);
  const int y0 = low(a.y, b.y, c.y), y1 = std::min(high(a.y, b.y, c.y), view.pixels - 1);
  if (x1 < x0 || y1 < y0) return;
  const float inverse = 1 / area;
  for (int y = y0; y <= y1; ++y) {
    const float py = static_cast<float>(y) + 0.5f;
    for (int x = x0; x <= x1; ++x) {
      const float px = static_cast<float>(x) + 0.5f;
      const float u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) * inverse;
      const float v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) * inverse;
      const float w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const float depth = u * a.z + v * b.z + w * c.z;
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.pixels) + static_cast<std::size_t>(x);
      near_[at] = std::max(near_[at], depth);
      far_[at] = std::min(far_[at], depth);
    }
  }
}

void DepthPicture::draw(const FlatMesh& mesh) {
  const auto count = static_cast<std::size_t>(view.pixels) * static_cast<std::size_t>(view.pixels);
  near_.assign(count, -1e30f);
  far_.assign(count, 1e30f);
  vertices.resize(mesh.positions.size());
  std::transform(mesh.positions.begin(), mesh.positions.end(), vertices.begin(), [&](const glm::vec3& p) { return view.pixelOf(p); });
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
    drawTriangle(vertices[mesh.triangles[i]], vertices[mesh.triangles[i + 1]], vertices[mesh.triangles[i + 2]]);
}

/// `count` directions spread evenly over the upper half of the sphere (a Fibonacci spiral).
std::vector<glm::vec3> skyDirections(int count) {
  std::vector<glm::vec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double height = (k + 0.5) / count, out = std::sqrt(1 - height * height);
    directions.emplace_back(out * std::cos(golden * k), height, out * std::sin(golden * k));
  }
  return directions;
}

/// Directions over the sun's disc, each standing for the same share of it.
std::vector<glm::vec3> sunDiscDirections() {
  std::vector<glm::vec3> directions;
  const LightView frame = viewAlong(sunDirection(), glm::vec3(0), 1, 1);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < sunDirections; ++k) {
    const double out = sunSpread * std::sqrt((k + 0.5) / sunDirections);
    directions.push_back(glm::normalize(frame.towards + frame.right * static_cast<float>(out * std::cos(golden * k)) +
                                        frame.up * static_cast<float>(out * std::sin(golden * k))));
  }
  return directions;
}

/// A sky that is three times as bright overhead as at the horizon (the overcast sky of Moon and Spencer).
float skyBrightness(float height) { return (1 + 2 * height) / 3; }

/// Gathers, direction after direction, what reaches each point.
class Gathering {
 public:
  Gathering(const FlatMesh& mesh, const std::vector<Point>& points) : mesh_(mesh), points_(points), light_(points.size(), PointLight{0, 0, 0, 0, 0}) {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const glm::vec3& p : mesh.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    centre_ = (low + high) * 0.5f;
    radius_ = std::max(0.5f * glm::length(high - low), 1e-9f);
  }

  [[nodiscard]] glm::vec3 centre() const { return centre_; }
  [[nodiscard]] float radius() const { return radius_; }

  void gatherSun() {
    forPictures(sunDiscDirections(), sunPixels, [](const DepthPicture& picture, const Point& point, PointLight& light) {
      light.sun += picture.reachedFromLight(picture.view.pixelOf(point.at)) ? 1.0f / sunDirections : 0.0f;
    });
  }

  /// `pairs` directions upwards and as many downwards, which see the ground.
  void gatherSky(int pairs) {
    float sky = 0, ground = 0;  // what a surface facing straight up (down) gets with nothing in the way
    const std::vector<glm::vec3> directions = skyDirections(pairs);
    for (const glm::vec3& d : directions) {
      sky += d.y * skyBrightness(d.y);
      ground += d.y;
    }
    forPictures(directions, skyPixels, [&](const DepthPicture& picture, const Point& point, PointLight& light) {
      const glm::vec3& d = picture.view.towards;
      const glm::vec3 pixel = picture.view.pixelOf(point.at);
      const float cosine = glm::dot(point.normal, d);
      const float fromSky = picture.reachedFromLight(pixel) ? std::abs(cosine) * skyBrightness(d.y) / sky : 0.0f;
      const float fromGround = picture.reachedFromBehind(pixel) ? std::abs(cosine) / ground : 0.0f;
      (cosine > 0 ? light.skyFront : light.skyBack) += fromSky;
      (cosine > 0 ? light.groundBack : light.groundFront) += fromGround;
    });
  }

  [[nodiscard]] std::vector<PointLight> take() { return std::move(light_); }

 private:
  template <class Take>
  void forPictures(const std::vector<glm::vec3>& directions, int pixels, const Take& takeLight) {
    constexpr std::size_t atOnce = 8, chunk = 4096;
    std::vector<DepthPicture> pictures(std::min(atOnce, directions.size()));
    for (std::size_t first = 0; first < directions.size(); first += atOnce) {
      const std::size_t count = std::min(atOnce, directions.size() - first);
      inParallel(count, [&](std::size_t k) {
        pictures[k].view = viewAlong(directions[first + k], centre_, radius_, pixels);
        pictures[k].draw(mesh_);
      });
      inParallel((points_.size() + chunk - 1) / chunk, [&](std::size_t c) {
        for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, points_.size()); ++i)
          for (std::size_t k = 0; k < count; ++k) takeLight(pictures[k], points_[i], light_[i]);
      });
    }
  }

  const FlatMesh& mesh_;
  const std::vector<Point>& points_;
  std::vector<PointLight> light_;
  glm::vec3 centre_{0};
  float radius_ = 1;
};

int skyPairsFor(std::size_t triangles) {
  const double affordable = triangleBudget / std::max<double>(static_cast<double>(triangles), 1);
  return static_cast<int>(std::clamp<double>(affordable, fewestSkyPairs, mostSkyPairs));
}

/// The part of the ground that the plant can darken: under it, and as far as its shadow reaches.
GroundShade groundAround(const FlatMesh& mesh, double height) {
  glm::vec3 low(1e30f), high(-1e30f);
  for (const glm::vec3& p : mesh.positions) {
    const glm::vec3 onGround = p - sunDirection() * std::max(0.0f, (p.y - static_cast<float>(height)) / sunDirection().y);
    low = glm::min(low, glm::min(p, onGround));
    high = glm::max(high, glm::max(p, onGround));
  }
  const double across = std::max<double>(high.x - low.x, high.z - low.z), tall = std::max<double>(high.y - height, 0);
  const double margin = 0.25 * across + 0.35 * tall;
  GroundShade ground;
  ground.size = groundCells;
  ground.cell = std::max((across + 2 * margin) / groundCells, 1e-9);
  ground.low = glm::dvec2(0.5 * (low.x + high.x), 0.5 * (low.z + high.z)) - 0.5 * ground.cell * groundCells;
  return ground;
}

std::vector<Point> groundPoints(const GroundShade& ground, double height) {
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(ground.size) * static_cast<std::size_t>(ground.size));
  for (int z = 0; z < ground.size; ++z)
    for (int x = 0; x < ground.size; ++x)
      points.push_back({.at = glm::vec3(ground.low.x + (x + 0.5) * ground.cell, height, ground.low.y + (z + 0.5) * ground.cell), .normal = {0, 1, 0}});
  return points;
}

/// A small blur, along the rows and then along the columns.
void blur(std::vector<float>& values, int size) {
  std::vector<float> row(static_cast<std::size_t>(size));
  const auto pass = [&](std::size_t first, std::size_t step) {
    for (int i = 0; i < size; ++i) {
      const auto at = [&](int k) { return values[first + step * static_cast<std::size_t>(std::clamp(k, 0, size - 1))]; };
      row[static_cast<std::size_t>(i)] = (at(i - 2) + 4 * at(i - 1) + 6 * at(i) + 4 * at(i + 1) + at(i + 2)) / 16;
    }
    for (int i = 0; i < size; ++i) values[first + step * static_cast<std::size_t>(i)] = row[static_cast<std::size_t>(i)];
  };
  for (int i = 0; i < size; ++i) pass(static_cast<std::size_t>(i) * static_cast<std::size_t>(size), 1);
  for (int i = 0; i < size; ++i) pass(static_cast<std::size_t>(i), static_cast<std::size_t>(size));
}

GroundShade shadedGround(GroundShade ground, std::span<const PointLight> light) {
  std::vector<float> sky;
  sky.reserve(light.size());
  ground.shade.reserve(light.size());
  for (const PointLight& l : light) {
    ground.shade.push_back(l.sun);
    sky.push_back(l.skyFront);
  }
  blur(ground.shade, ground.size);
  for (int pass = 0; pass < skyBlurs; ++pass) blur(sky, ground.size);
  for (std::size_t i = 0; i < sky.size(); ++i) ground.shade[i] = sunOnGround * ground.shade[i] + skyOnGround * sky[i];
  return ground;
}

std::vector<Point> pointsOf(const FlatMesh& mesh) {
  std::vector<Point> points(mesh.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {.at = mesh.positions[i], .normal = mesh.normals[i]};
  return points;
}

}  // namespace

glm::vec3 sunDirection() { return glm::normalize(glm::vec3(-0.50f, 1.40f, 0.62f)); }

double GroundShade::at(double x, double z) const {
  if (cell <= 0) return 1;
  const double u = (x - low.x) / cell - 0.5, v = (z - low.y) / cell - 0.5;
  if (u < 0 || v < 0 || u >= size - 1 || v >= size - 1) return 1;
  const int i = static_cast<int>(u), k = static_cast<int>(v);
  const double fu = u - i, fv = v - k;
  const auto cellAt = [&](int a, int b) { return static_cast<double>(shade[static_cast<std::size_t>(b) * static_cast<std::size_t>(size) + static_cast<std::size_t>(a)]); };
  const double value = (cellAt(i, k) * (1 - fu) + cellAt(i + 1, k) * fu) * (1 - fv) + (cellAt(i, k + 1) * (1 - fu) + cellAt(i + 1, k + 1) * fu) * fv;
  // The square's rim must not show: its last tenth goes over to open ground.
  const double rim = std::min({u, v, size - 1 - u, size - 1 - v}) / (0.1 * size);
  return rim >= 1 ? value : 1 + (value - 1) * rim;
}

Daylight daylightOn(const FlatMesh& mesh, const DaylightOptions& options) {
  if (mesh.triangles.empty()) return {};
  std::vector<Point> points = pointsOf(mesh);
  Daylight daylight;
  if (options.ground == GroundLight::Shaded) {
    daylight.ground = groundAround(mesh, options.groundHeight);
    const std::vector<Point> onGround = groundPoints(daylight.ground, options.groundHeight);
    points.insert(points.end(), onGround.begin(), onGround.end());
  }
  Gathering gathering(mesh, points);
  gathering.gatherSun();
  gathering.gatherSky(skyPairsFor(mesh.triangles.size() / 3));
  std::vector<PointLight> light = gathering.take();
  if (options.ground == GroundLight::Shaded)
    daylight.ground = shadedGround(std::move(daylight.ground), std::span(light).subspan(mesh.positions.size()));
  light.resize(mesh.positions.size());
  daylight.vertices = std::move(light);
  return daylight;
}

}  // namespace axil::render
