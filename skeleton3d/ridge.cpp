#include "skeleton3d/ridge.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr float kLikelihoodWeight = 1.0F;

glm::vec4 pixel(const Photo& photo, const StemLikelihood& likelihood, int x, int y) {
  const std::size_t i = static_cast<std::size_t>(std::clamp(y, 0, photo.height - 1)) * static_cast<std::size_t>(photo.width) +
                        static_cast<std::size_t>(std::clamp(x, 0, photo.width - 1));
  const std::uint8_t* rgb = photo.rgb.data() + 3 * i;
  return {rgb[0], rgb[1], rgb[2], likelihood.empty() ? 0.0F : static_cast<float>(likelihood[i])};
}

glm::vec4 bilinear(const Photo& photo, const StemLikelihood& likelihood, glm::dvec2 at) {
  const double x = at.x - 0.5, y = at.y - 0.5;  // the first pixel's centre is (0.5, 0.5)
  const double fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const auto u = static_cast<float>(x - fx), v = static_cast<float>(y - fy);
  if (likelihood.empty() && ix >= 0 && iy >= 0 && ix + 1 < photo.width && iy + 1 < photo.height) {  // nearly always, and three times as fast
    const std::size_t row = std::size_t{3} * static_cast<std::size_t>(photo.width);
    const std::uint8_t *above = photo.rgb.data() + static_cast<std::size_t>(iy) * row + std::size_t{3} * static_cast<std::size_t>(ix), *below = above + row;
    const auto colour = [](const std::uint8_t* rgb) { return glm::vec4(rgb[0], rgb[1], rgb[2], 0.0F); };
    return (colour(above) * (1 - u) + colour(above + 3) * u) * (1 - v) + (colour(below) * (1 - u) + colour(below + 3) * u) * v;
  }
  return (pixel(photo, likelihood, ix, iy) * (1 - u) + pixel(photo, likelihood, ix + 1, iy) * u) * (1 - v) +
         (pixel(photo, likelihood, ix, iy + 1) * (1 - u) + pixel(photo, likelihood, ix + 1, iy + 1) * u) * v;
}

glm::vec4 nearest(const Photo& photo, const StemLikelihood& likelihood, glm::dvec2 at) {
  return pixel(photo, likelihood, static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
}

/// The derivative of a Gaussian, scaled so that a step of height h gives h at its place.
std::vector<float> slopeKernel(double blur_px) {
  const double sigma = blur_px / kRidgeStep_px;
  const int half = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel;
  double sum = 0;
  for (int k = -half; k <= half; ++k) sum += k > 0 ? k * std::exp(-0.5 * k * k / (sigma * sigma)) : 0;
  for (int k = -half; k <= half; ++k) kernel.push_back(static_cast<float>(k * std::exp(-0.5 * k * k / (sigma * sigma)) / sum));
  return kernel;
}

std::vector<glm::vec4> slopesOf(const std::vector<glm::vec4>& colour, double blur_px) {
  const std::vector<float> kernel = slopeKernel(blur_px);
  const int half = static_cast<int>(kernel.size() / 2), count = static_cast<int>(colour.size());
  std::vector<glm::vec4> slope(colour.size(), glm::vec4(0.0F));
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int i = 0; i < count; ++i) {
    glm::vec4 sum(0.0F);
    if (i >= half && i + half < count)
      for (int k = 1; k <= half; ++k) sum += kernel[at(half + k)] * (colour[at(i + k)] - colour[at(i - k)]);  // the kernel is odd
    else
      for (int k = -half; k <= half; ++k) sum += kernel[at(k + half)] * colour[at(std::clamp(i + k, 0, count - 1))];
    slope[at(i)] = sum;
  }
  return slope;
}

glm::vec4 slopeAt(const RidgeProfile& profile, double at) {
  const double place = std::clamp((at + profile.reach_px) / kRidgeStep_px, 0.0, static_cast<double>(profile.slope.size() - 1) - 1e-9);
  const auto i = static_cast<std::size_t>(place);
  const auto f = static_cast<float>(place - static_cast<double>(i));
  return profile.slope[i] * (1 - f) + profile.slope[i + 1] * f;
}

/// Of two edges with these slopes.
double strengthOf(const RidgeProfile& profile, const glm::vec4& atLeft, const glm::vec4& atRight) {
  const glm::vec4 out = -atRight;  // inside minus outside, both
  const glm::vec3 a(atLeft), b(out);
  const double la = glm::length(a), lb = glm::length(b);
  const double alike = la * lb > 0 ? glm::dot(a, b) / (la * lb) : 0;
  const double colour = std::min(la, lb) * (2 + alike) / 3;
  if (!profile.hasLikelihood) return colour;
  const double stem = std::min(atLeft.w, out.w);
  return stem <= 0 ? 0 : std::min(colour, 60.0) * 0.5 + kLikelihoodWeight * stem;
}

double edgeOf(const RidgeProfile& profile, const glm::vec4& slope, StemSide side) {
  if (!profile.hasLikelihood) return glm::length(glm::vec3(slope));
  return side == StemSide::Left ? slope.w : -slope.w;
}

}  // namespace

RidgeProfile profileAcross(const Photo& photo, const StemLikelihood& likelihood, glm::dvec2 centre, glm::dvec2 across, const ProfileOptions& options) {
  RidgeProfile profile;
  profile.hasLikelihood = !likelihood.empty();
  const int half = static_cast<int>(std::ceil(options.reach_px / kRidgeStep_px));
  profile.reach_px = half * kRidgeStep_px;
  const glm::dvec2 along{-across.y, across.x};
  const int stride = options.along_px >= 3 ? options.along_px : 1;
  const auto sampled = options.sampling == Sampling::NearestPixel ? nearest : bilinear;
  for (int i = -half; i <= half; ++i) {
    const glm::dvec2 at = centre + i * kRidgeStep_px * across;
    glm::vec4 sum(0.0F);
    for (int k = -options.along_px; k <= options.along_px; k += stride) sum += sampled(photo, likelihood, at + static_cast<double>(k) * along);
    profile.colour.push_back(sum / static_cast<float>(2 * options.along_px / stride + 1));
  }
  profile.slope = slopesOf(profile.colour, options.blur_px);
  return profile;
}

double ridgeStrength(const RidgeProfile& profile, double left, double right) { return strengthOf(profile, slopeAt(profile, left), slopeAt(profile, right)); }

double ridgeStrengthOfKnownWidth(const RidgeProfile& profile, double left, double right) {
  const glm::vec4 atLeft = slopeAt(profile, left), atRight = slopeAt(profile, right);
  const double both = strengthOf(profile, atLeft, atRight);
  const double a = edgeOf(profile, atLeft, StemSide::Left), b = edgeOf(profile, atRight, StemSide::Right);
  const double one = std::min(a, b) < -0.15 * std::max(a, b) ? 0 : 0.45 * std::max(a, b);
  return std::max(both, one);
}

double edgeStrength(const RidgeProfile& profile, double at, StemSide side) { return edgeOf(profile, slopeAt(profile, at), side); }

double sharpened(const RidgeProfile& profile, double at, double reach_px) {
  const auto heightAt = [&](double x) { return static_cast<double>(glm::length(slopeAt(profile, x))); };
  double best = at;
  const int steps = static_cast<int>(reach_px / kRidgeStep_px);
  for (int i = -steps; i <= steps; ++i)
    if (const double x = at + i * kRidgeStep_px; heightAt(x) > heightAt(best)) best = x;
  const double before = heightAt(best - kRidgeStep_px), here = heightAt(best), after = heightAt(best + kRidgeStep_px);
  const double bend = before - 2 * here + after;
  return bend < 0 ? best + std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) * kRidgeStep_px : best;
}

}  // namespace axil::skeleton3d
