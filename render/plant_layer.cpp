#include "render/plant_layer.hpp"

#include "skeleton3d/camera.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <cmath>

namespace axil::render {
namespace {

/// Samples a side of a pixel, and the largest piece of a picture that is drawn at once (in pixels of the picture).
constexpr int samples = 2, tileSide = 2048;

// ---- shading ---------------------------------------------------------------------------------------------------------

constexpr const char* vertexShader = R"(//VTK::System::Dec
in vec4 vertexMC;
in vec4 normalAndHeight;
in vec4 colourAndSun;
in vec4 skyAndGround;
in vec2 surface;
uniform mat4 MCDCMatrix;
out vec3 viewPosition;
out vec4 nh;
out vec4 cs;
out vec4 sg;
out vec2 sf;
void main() {
  viewPosition = vertexMC.xyz;
  nh = normalAndHeight;
  cs = colourAndSun;
  sg = skyAndGround;
  sf = surface;
  gl_Position = MCDCMatrix * vertexMC;
}
)";

/// Sun, sky and ground light on a matt surface with a little gloss; a blade lets light through and is paler below.
constexpr const char* fragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec3 viewPosition;
in vec4 nh;
in vec4 cs;
in vec4 sg;
in vec2 sf;
//VTK::CustomUniforms::Dec

// Reinhard's curve with a white point: bright things lose strength of colour, as on film.
vec3 filmic(vec3 x) {
  float l = dot(x, vec3(0.2126, 0.7152, 0.0722));
  vec3 byChannel = x * (1.0 + x / 9.0) / (1.0 + x);
  vec3 byLightness = x * (1.0 + l / 9.0) / (1.0 + l);
  return clamp(mix(byChannel, byLightness, 0.4), 0.0, 1.0);
}

vec3 encoded(vec3 linear) { return mix(linear * 12.92, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear)); }

void main() {
  if (nh.w < floorHeight) discard;
  bool blade = sf.x > 0.5;
  vec3 n = normalize(nh.xyz);
  vec3 v = isParallel > 0 ? vec3(0.0, 0.0, 1.0) : normalize(-viewPosition);
  vec3 albedo = cs.rgb;
  float skyHere = sg.x, skyThere = sg.y, groundHere = sg.z, groundThere = sg.w;
  bool below = dot(n, v) < 0.0;
  if (below) {
    n = -n;
    skyHere = sg.y; skyThere = sg.x; groundHere = sg.w; groundThere = sg.z;
    if (blade) albedo = mix(albedo, vec3(dot(albedo, vec3(0.3, 0.5, 0.2))) * vec3(1.02, 1.06, 0.92), 0.30) * 1.12;
  }
  float cosine = dot(n, sunwards);
  vec3 light = sunColour * (max(cosine, 0.0) * cs.a) + skyColour * skyHere + groundColour * groundHere;
  vec3 colour = albedo * light;
  if (blade) {
    float green = clamp(3.0 * (albedo.g - max(albedo.r, albedo.b)) / max(albedo.g, 0.01), 0.0, 1.0);
    vec3 through = albedo * mix(vec3(1.0), vec3(1.25, 1.35, 0.55), green);
    colour += through * (sunColour * (0.55 * max(-cosine, 0.0) * cs.a) + 0.28 * (skyColour * skyThere + groundColour * groundThere));
  }
  vec3 h = normalize(v + sunwards);
  float sharpness = mix(90.0, 10.0, sf.y);
  float gloss = pow(max(dot(n, h), 0.0), sharpness) * mix(0.35, 0.045, sf.y) * step(0.0, cosine) * cs.a;
  float rim = pow(1.0 - max(dot(n, v), 0.0), 4.0);
  colour += sunColour * gloss + skyColour * skyHere * rim * mix(0.10, 0.03, sf.y);
  gl_FragData[0] = vec4(encoded(filmic(colour)), 1.0);
}
)";

constexpr float sunColour[3] = {2.60f, 2.42f, 2.12f};
constexpr float skyColour[3] = {1.15f, 1.20f, 1.30f};
constexpr float groundColour[3] = {0.55f, 0.51f, 0.46f};

// ---- the mesh, before the camera -------------------------------------------------------------------------------------

/// VTK looks along -Z with Y up, a photo's camera along +Z with y down.
glm::dvec3 turnedOver(const glm::dvec3& v) { return {v.x, -v.y, -v.z}; }

bool isDistorted(const skeleton3d::Camera& camera) {
  return camera.model == skeleton3d::CameraModel::Perspective && camera.distortion != std::array<double, 5>{};
}

/// A point of the plant before the camera. Lens distortion moves it sideways to where its pixel is, at the same depth.
glm::dvec3 beforeCamera(const skeleton3d::Camera& camera, const glm::vec3& p, bool distorted) {
  const PlantPoint point{glm::dvec3(p)};
  glm::dvec3 at = skeleton3d::toView(camera, point).at;
  if (distorted && at.z > 0) {
    const glm::dvec2 pixel = skeleton3d::project(camera, point).px;
    at.x = (pixel.x - camera.centre_px.x) / camera.focal_px->x * at.z;
    at.y = (pixel.y - camera.centre_px.y) / camera.focal_px->y * at.z;
  }
  return turnedOver(at);
}

struct DepthRange {
  double near_ = 0;
  double far_ = 1;
};

/// What lies before the camera, a little widened; behind a perspective camera nothing is drawn.
DepthRange depthRangeOf(vtkPoints& points, bool perspective) {
  double bounds[6];
  points.GetBounds(bounds);
  DepthRange range{-bounds[5], -bounds[4]};
  const double slack = 1e-3 * std::max(range.far_ - range.near_, 1e-6 * std::abs(range.far_)) + 1e-12;
  range.near_ -= slack;
  range.far_ += slack;
  if (perspective) range.near_ = std::max(range.near_, 1e-4 * std::abs(range.far_));
  return range;
}

vtkNew<vtkFloatArray> attribute(const char* name, int components, std::size_t count) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  return array;
}

void setVertices(vtkPolyData& data, const LayerScene& scene) {
  const FlatMesh& mesh = scene.mesh;
  const std::size_t count = mesh.positions.size();
  const bool distorted = isDistorted(scene.camera);
  const auto places = attribute("place", 3, count), normals = attribute("normalAndHeight", 4, count), colours = attribute("colourAndSun", 4, count),
             light = attribute("skyAndGround", 4, count), surfaces = attribute("surface", 2, count);
  float *p = places->GetPointer(0), *n = normals->GetPointer(0), *c = colours->GetPointer(0), *l = light->GetPointer(0), *s = surfaces->GetPointer(0);
  const auto put = [](float*& to, auto... values) { ((*to++ = static_cast<float>(values)), ...); };
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 at = beforeCamera(scene.camera, mesh.positions[i], distorted);
    const glm::dvec3 normal = turnedOver(scene.camera.rotation * glm::dvec3(mesh.normals[i]));
    const Material& material = scene.plant.materials[static_cast<std::size_t>(mesh.materials[i])];
    const PointLight& lit = scene.light[i];
    put(p, at.x, at.y, at.z);
    put(n, normal.x, normal.y, normal.z, mesh.positions[i].y);
    put(c, mesh.colours[i].r, mesh.colours[i].g, mesh.colours[i].b, lit.sun);
    put(l, lit.skyFront, lit.skyBack, lit.groundFront, lit.groundBack);
    put(s, material.surface == Surface::Blade ? 1 : 0, material.roughness);
  }
  vtkNew<vtkPoints> points;
  points->SetData(places);
  data.SetPoints(points);
  for (vtkFloatArray* array : {normals.Get(), colours.Get(), light.Get(), surfaces.Get()}) data.GetPointData()->AddArray(array);
}

void setTriangles(vtkPolyData& data, const FlatMesh& mesh) {
  const auto corners = static_cast<vtkIdType>(mesh.triangles.size());
  vtkNew<vtkTypeInt32Array> offsets, connectivity;
  offsets->SetNumberOfValues(corners / 3 + 1);
  for (vtkIdType i = 0; i <= corners / 3; ++i) offsets->SetValue(i, static_cast<vtkTypeInt32>(3 * i));
  connectivity->SetNumberOfValues(corners);
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), connectivity->GetPointer(0), [](std::uint32_t v) { return static_cast<vtkTypeInt32>(v); });
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  data.SetPolys(cells);
}

// ---- the scene -------------------------------------------------------------------------------------------------------

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Projection onto one tile of the picture, exact for any principal point.
vtkNew<vtkMatrix4x4> projectionOnto(const Tile& tile, const skeleton3d::Camera& camera, const DepthRange& range) {
  const bool perspective = camera.model == skeleton3d::CameraModel::Perspective;
  const glm::dvec2 focal = perspective ? *camera.focal_px : glm::dvec2(camera.scale_px_per_unit);
  const double cx = camera.centre_px.x - tile.x, cy = camera.centre_px.y - tile.y;
  const double w = tile.width, h = tile.height, near_ = range.near_, far_ = range.far_;
  vtkNew<vtkMatrix4x4> m;
  m->Zero();
  m->SetElement(0, 0, 2 * focal.x / w);
  m->SetElement(1, 1, 2 * focal.y / h);
  const int offsets = perspective ? 2 : 3;  // perspective: times depth (-z); orthographic: constant
  m->SetElement(0, offsets, (perspective ? -1 : 1) * (2 * cx / w - 1));
  m->SetElement(1, offsets, (perspective ? -1 : 1) * (1 - 2 * cy / h));
  if (perspective) {
    m->SetElement(2, 2, -(far_ + near_) / (far_ - near_));
    m->SetElement(2, 3, -2 * far_ * near_ / (far_ - near_));
    m->SetElement(3, 2, -1);
  } else {
    m->SetElement(2, 2, -2 / (far_ - near_));
    m->SetElement(2, 3, -(far_ + near_) / (far_ - near_));
    m->SetElement(3, 3, 1);
  }
  return m;
}

void setShading(vtkActor& actor, const LayerScene& scene) {
  vtkShaderProperty& shader = *actor.GetShaderProperty();
  shader.SetVertexShaderCode(vertexShader);
  shader.SetFragmentShaderCode(fragmentShader);
  const glm::dvec3 sun = turnedOver(scene.camera.rotation * glm::dvec3(sunDirection()));
  const float sunwards[3] = {static_cast<float>(sun.x), static_cast<float>(sun.y), static_cast<float>(sun.z)};
  vtkUniforms& uniforms = *shader.GetFragmentCustomUniforms();
  uniforms.SetUniform3f("sunwards", sunwards);
  uniforms.SetUniform3f("sunColour", sunColour);
  uniforms.SetUniform3f("skyColour", skyColour);
  uniforms.SetUniform3f("groundColour", groundColour);
  uniforms.SetUniformf("floorHeight", static_cast<float>(scene.floor.value_or(-1e30)));
  uniforms.SetUniformi("isParallel", scene.camera.model == skeleton3d::CameraModel::Orthographic ? 1 : 0);
}

void setMapper(vtkOpenGLPolyDataMapper& mapper, vtkPolyData& data) {
  mapper.SetInputData(&data);
  mapper.ScalarVisibilityOff();
  mapper.SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  for (const char* name : {"normalAndHeight", "colourAndSun", "skyAndGround", "surface"})
    mapper.MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS);
}

/// The mean of the samples of each pixel, from a tile whose rows come from the bottom.
void putTile(Layer& layer, const Tile& tile, const std::vector<std::uint8_t>& pixels) {
  const auto rowBytes = static_cast<std::size_t>(tile.width) * samples * 4;
  for (int y = 0; y < tile.height; ++y) {
    std::uint8_t* to = layer.rgba.data() + 4 * (static_cast<std::size_t>(tile.y + y) * static_cast<std::size_t>(layer.width_px) + static_cast<std::size_t>(tile.x));
    const std::uint8_t* above = pixels.data() + rowBytes * static_cast<std::size_t>(samples * (tile.height - y) - 1);
    const std::uint8_t* below = above - rowBytes;
    for (int x = 0; x < tile.width; ++x, above += 8, below += 8)
      for (int channel = 0; channel < 4; ++channel)
        *to++ = static_cast<std::uint8_t>((above[channel] + above[channel + 4] + below[channel] + below[channel + 4] + 2) / 4);
  }
}

std::vector<Tile> tilesOf(int width_px, int height_px) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height_px; y += tileSide)
    for (int x = 0; x < width_px; x += tileSide) tiles.push_back({x, y, std::min(tileSide, width_px - x), std::min(tileSide, height_px - y)});
  return tiles;
}

}  // namespace

Result<Layer> drawLayer(HeadlessWindow& window, const LayerScene& scene, const LayerSize& size) {
  const auto [width_px, height_px, edgeSamples] = size;
  Layer layer{.width_px = width_px, .height_px = height_px, .rgba = std::vector<std::uint8_t>(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4)};
  if (scene.mesh.triangles.empty()) return layer;

  vtkNew<vtkPolyData> data;
  setVertices(*data, scene);
  setTriangles(*data, scene.mesh);
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  setMapper(*mapper, *data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->ForceOpaqueOn();
  setShading(*actor, scene);

  vtkNew<vtkRenderer> renderer;
  renderer->GetCullers()->RemoveAllItems();
  renderer->SetBackground(0, 0, 0);
  renderer->SetBackgroundAlpha(0);
  renderer->AddActor(actor);
  vtkCamera& eye = *renderer->GetActiveCamera();
  eye.SetPosition(0, 0, 0);
  eye.SetFocalPoint(0, 0, -1);
  eye.SetViewUp(0, 1, 0);
  eye.SetUseExplicitProjectionTransformMatrix(true);
  const bool perspective = scene.camera.model == skeleton3d::CameraModel::Perspective;
  const DepthRange range = depthRangeOf(*data->GetPoints(), perspective);
  if (perspective && range.far_ <= 0) return layer;  // all of it is behind the camera
  for (const Tile& tile : tilesOf(width_px, height_px)) {
    eye.SetExplicitProjectionTransformMatrix(projectionOnto(tile, scene.camera, range));
    const auto pixels = window.draw(*renderer, {tile.width * samples, tile.height * samples, edgeSamples});
    if (!pixels) {
      window.forget(*renderer);
      return pixels.failure();
    }
    putTile(layer, tile, *pixels);
  }
  window.forget(*renderer);
  return layer;
}

}  // namespace axil::render
