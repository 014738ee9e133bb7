#include "render/colour.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::render {
namespace {

using simeco::OrganKind;

struct Hsv {
  double hue = 0;  ///< degrees
  double saturation = 0;
  double value = 0;
};

Hsv hsvOf(const glm::dvec3& rgb) {
  const double high = std::max({rgb.r, rgb.g, rgb.b});
  const double low = std::min({rgb.r, rgb.g, rgb.b});
  const double range = high - low;
  if (range <= 0) return {0, 0, high};
  double hue = 0;
  if (high == rgb.r) hue = 60 * ((rgb.g - rgb.b) / range);
  else if (high == rgb.g) hue = 60 * ((rgb.b - rgb.r) / range) + 120;
  else hue = 60 * ((rgb.r - rgb.g) / range) + 240;
  return {hue < 0 ? hue + 360 : hue, range / high, high};
}

glm::dvec3 rgbOf(const Hsv& hsv) {
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hsv.hue / 60, 6.0);
    return hsv.value * (1 - hsv.saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

/// `x` up to the knee, then ever slower towards `limit`, which it never passes.
double softLimit(double x, double knee, double limit) {
  if (x <= knee) return x;
  return knee + (limit - knee) * (1 - std::exp(-(x - knee) / (limit - knee)));
}

/// How strong and how bright an organ of this kind is, and how far its greens move to a leaf's hue.
struct Palette {
  double saturationKnee, saturationLimit, valueKnee, valueLimit, greenPull;
};

Palette paletteOf(OrganKind kind) {
  switch (kind) {
    case OrganKind::Leaf: return {0.36, 0.57, 0.32, 0.46, 0.75};
    case OrganKind::Apex: return {0.35, 0.55, 0.36, 0.52, 0.60};
    case OrganKind::Stem: return {0.22, 0.38, 0.36, 0.48, 0.90};
    case OrganKind::Root: return {0.20, 0.35, 0.40, 0.62, 0.80};
    case OrganKind::Fruit: return {0.60, 0.85, 0.60, 0.82, 0.40};
    case OrganKind::Flower: return {0.65, 0.88, 0.85, 0.96, 0.30};
  }
  return {};
}

/// Where a healthy leaf's hue lies, degrees; and the range of hues that are called green.
constexpr double leafHue = 86, greenFrom = 65, greenTo = 170;
/// From here to green are the hues of stems: brown, ochre, olive.
constexpr double stemHueFrom = 15;

float linearOf(double s) { return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4)); }
double srgbOf(double l) { return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

}  // namespace

glm::vec3 linearFromSrgb(const glm::dvec3& srgb) {
  const glm::dvec3 c = glm::clamp(srgb, 0.0, 1.0);
  return {linearOf(c.r), linearOf(c.g), linearOf(c.b)};
}

glm::dvec3 srgbFromLinear(const glm::vec3& linear) {
  const glm::dvec3 c = glm::clamp(glm::dvec3(linear), 0.0, 1.0);
  return {srgbOf(c.r), srgbOf(c.g), srgbOf(c.b)};
}

Rgb8 rgb8FromLinear(const glm::vec3& linear) {
  const glm::dvec3 c = srgbFromLinear(linear) * 255.0 + 0.5;
  return {static_cast<std::uint8_t>(c.r), static_cast<std::uint8_t>(c.g), static_cast<std::uint8_t>(c.b)};
}

glm::vec3 naturalColour(const glm::dvec4& named, OrganKind kind) {
  Hsv hsv = hsvOf(glm::clamp(glm::dvec3(named), 0.0, 1.0));
  // Wood, rind and green are muted; who asks for a red, blue or violet stem means it.
  const bool stemHue = hsv.hue > stemHueFrom && hsv.hue < greenTo;
  const Palette palette = paletteOf(kind == OrganKind::Stem && !stemHue ? OrganKind::Fruit : kind);
  const double strength = std::clamp((hsv.saturation - palette.saturationKnee) / 0.3, 0.0, 1.0);
  if (hsv.hue > greenFrom && hsv.hue < greenTo) hsv.hue += palette.greenPull * strength * (leafHue - hsv.hue);
  hsv.saturation = softLimit(hsv.saturation, palette.saturationKnee, palette.saturationLimit);
  hsv.value = softLimit(hsv.value, palette.valueKnee, palette.valueLimit);
  return linearFromSrgb(rgbOf(hsv));
}

glm::vec3 paintColour(const glm::dvec4& named) {
  const Hsv hsv = hsvOf(glm::clamp(glm::dvec3(named), 0.0, 1.0));
  const bool green = hsv.hue > greenFrom && hsv.hue < greenTo && hsv.saturation > 0.1;
  return naturalColour(named, green ? OrganKind::Leaf : OrganKind::Flower);
}

glm::vec3 defaultColour(OrganKind kind) {
  switch (kind) {
    case OrganKind::Leaf: return linearFromSrgb({0.33, 0.46, 0.20});
    case OrganKind::Apex: return linearFromSrgb({0.45, 0.52, 0.28});
    case OrganKind::Stem: return linearFromSrgb({0.40, 0.45, 0.25});
    case OrganKind::Root: return linearFromSrgb({0.58, 0.50, 0.38});
    case OrganKind::Fruit: return linearFromSrgb({0.72, 0.26, 0.16});
    case OrganKind::Flower: return linearFromSrgb({0.93, 0.80, 0.86});
  }
  return glm::vec3(0.5f);
}

glm::vec3 barkColour() { return linearFromSrgb({0.43, 0.365, 0.285}); }

}  // namespace axil::render
