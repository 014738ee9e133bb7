#include "skeleton3d/report.hpp"

#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/photo.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

const cv::Scalar kGreen(80, 220, 80), kYellow(40, 220, 250), kRed(60, 60, 255), kWhite(255, 255, 255), kBlue(255, 160, 60);

/// A picture to draw on, and how photo pixels become its own.
struct Canvas {
  cv::Mat picture;
  double scale = 1;

  [[nodiscard]] cv::Point at(glm::dvec2 px) const { return {static_cast<int>(std::lround(px.x * scale)), static_cast<int>(std::lround(px.y * scale))}; }
};

glm::ivec2 sizeOf(const View& view) { return view.size_px.x > 0 ? view.size_px : glm::ivec2(2.0 * view.camera.centre_px); }

Result<Canvas> canvasOf(const std::optional<std::filesystem::path>& path, const View& view, int longestSide_px) {
  cv::Mat base;
  if (path) {
    const auto photo = readPhoto(*path);
    if (!photo) return photo.failure();
    const cv::Mat rgb(photo->height, photo->width, CV_8UC3, const_cast<std::uint8_t*>(photo->rgb.data()));
    cv::cvtColor(rgb, base, cv::COLOR_RGB2BGR);
    base.convertTo(base, CV_8UC3, 0.55, 0);
  } else {
    const glm::ivec2 size = sizeOf(view);
    if (size.x <= 0 || size.y <= 0) return fail(ErrorCode::NoAnswer, "view '" + view.name + "' has neither a photo nor a size to draw on; give size_px");
    base = cv::Mat(size.y, size.x, CV_8UC3, cv::Scalar(60, 60, 60));
  }
  Canvas canvas{base, std::min(1.0, static_cast<double>(longestSide_px) / std::max(base.cols, base.rows))};
  if (canvas.scale < 1) cv::resize(base, canvas.picture, {}, canvas.scale, canvas.scale, cv::INTER_AREA);
  return canvas;
}

void write(Canvas& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour, double size) {
  cv::putText(canvas.picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
  cv::putText(canvas.picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

const Node* placed(const Skeleton& skeleton, NodeId id) {
  const auto found = std::find_if(skeleton.nodes.begin(), skeleton.nodes.end(), [&](const Node& node) { return node.id == id; });
  return found == skeleton.nodes.end() ? nullptr : &*found;
}

void drawStems(const Skeleton& skeleton, const View& view, Canvas& canvas) {
  for (const Stem& stem : skeleton.stems)
    for (std::size_t k = 1; k < stem.nodes.size(); ++k) {
      const Node *from = placed(skeleton, stem.nodes[k - 1]), *to = placed(skeleton, stem.nodes[k]);
      if (from == nullptr || to == nullptr || !isInFront(view.camera, from->position) || !isInFront(view.camera, to->position)) continue;
      cv::line(canvas.picture, canvas.at(project(view.camera, from->position).px), canvas.at(project(view.camera, to->position).px), kBlue, 1, cv::LINE_AA);
    }
}

/// The miss of one click; gives its squared length.
double drawMiss(const Node& node, const View& view, PhotoPoint click, double click_px, double magnified, Canvas& canvas) {
  const glm::dvec2 at = project(view.camera, node.position).px, off = click.px - at;
  const double share = glm::length(off) / std::max(click_px, 1e-3);
  const cv::Scalar colour = share < 2 ? kGreen : share < 4 ? kYellow : kRed;
  cv::circle(canvas.picture, canvas.at(at), 2, colour, cv::FILLED, cv::LINE_AA);
  if (glm::length(off) * magnified * canvas.scale >= 1) cv::arrowedLine(canvas.picture, canvas.at(at), canvas.at(at + magnified * off), colour, 1, cv::LINE_AA, 0, 0.25);
  return glm::dot(off, off);
}

void drawLegend(const View& view, double rms_px, std::size_t clicks, double magnified, Canvas& canvas) {
  write(canvas, view.name + ": " + std::to_string(clicks) + " clicks, " + fixed(rms_px, 2) + " px rms from their nodes; arrows x" + fixed(magnified, 0), {12, 26}, kWhite, 0.6);
  write(canvas, "green < 2, yellow < 4, red > 4 standard deviations; ring: suspect; cross: waits for another view", {12, 48}, kWhite, 0.5);
}

std::string degreesOf(Angle angle) { return fixed(angle.degrees(), 1); }

std::string lineOf(const CameraReport& camera) {
  return "view " + camera.view + ": " + std::to_string(camera.clicks) + " clicks, " + fixed(camera.rms_px, 2) + " px rms, " + fixed(camera.typical_px, 2) + " px typically; turned by " +
         degreesOf(camera.turned) + " degrees from its name (nods " + degreesOf(camera.turnedAbout[0]) + ", aside " + degreesOf(camera.turnedAbout[1]) + ", rolls " +
         degreesOf(camera.turnedAbout[2]) + "); " +
         (camera.focal_px > 0 ? "focal length " + fixed(camera.focal_px, 0) + " +- " + fixed(camera.focalSigma_px, 0) + " px" : "seen as from very far") + "\n";
}

/// Of a camera that was known: how far its clicks are off.
std::string lineOf(const View& view, const Skeleton& skeleton) {
  double squares = 0;
  std::size_t clicks = 0;
  for (const Node& node : skeleton.nodes)
    if (const auto off = node.reprojection_px.find(view.name); off != node.reprojection_px.end()) {
      squares += off->second * off->second;
      ++clicks;
    }
  return "view " + view.name + ": " + std::to_string(clicks) + " clicks, " + fixed(clicks > 0 ? std::sqrt(squares / static_cast<double>(clicks)) : 0.0, 2) +
         " px rms; its camera was given\n";
}

}  // namespace

Result<std::string> residualPlot(const std::optional<std::filesystem::path>& photo, const View& view, std::span<const ClickedNode> clicks, const Skeleton& skeleton,
                                 std::span<const SuspectClick> suspects, double click_px, const ResidualPlotOptions& options) {
  auto canvas = canvasOf(photo, view, options.longestSide_px);
  if (!canvas) return canvas.failure();
  drawStems(skeleton, view, *canvas);
  double squares = 0;
  std::size_t drawn = 0;
  for (const ClickedNode& clicked : clicks) {
    const auto click = clicked.clicks.find(view.name);
    if (click == clicked.clicks.end()) continue;
    const bool suspect = std::any_of(suspects.begin(), suspects.end(), [&](const SuspectClick& s) { return s.node == clicked.id && s.view == view.name; });
    if (suspect) {
      cv::circle(canvas->picture, canvas->at(click->second.px), 12, kRed, 2, cv::LINE_AA);
      write(*canvas, std::to_string(clicked.id.value), canvas->at(click->second.px) + cv::Point(14, 5), kRed, 0.5);
    }
    const Node* node = placed(skeleton, clicked.id);
    if (node == nullptr) {
      cv::drawMarker(canvas->picture, canvas->at(click->second.px), kYellow, cv::MARKER_TILTED_CROSS, 12, 2, cv::LINE_AA);
    } else if (!suspect && isInFront(view.camera, node->position)) {
      squares += drawMiss(*node, view, click->second, click_px, options.magnified, *canvas);
      ++drawn;
    }
  }
  drawLegend(view, drawn > 0 ? std::sqrt(squares / static_cast<double>(drawn)) : 0.0, drawn, options.magnified, *canvas);
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", canvas->picture, bytes)) return fail(ErrorCode::Unwritable, "the picture of view '" + view.name + "' cannot be encoded");
  return std::string(bytes.begin(), bytes.end());
}

std::string reportText(std::span<const View> views, std::span<const CameraReport> cameras, std::span<const SuspectClick> suspects, const Uncertainty& uncertainty,
                       std::span<const std::string> notes, const Skeleton& skeleton) {
  std::string text;
  for (const View& view : views) {
    const auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const CameraReport& c) { return c.view == view.name; });
    text += camera == cameras.end() ? lineOf(view, skeleton) : lineOf(*camera);
    if (camera != cameras.end())
      for (const std::string& weak : camera->weak) text += "  weak: " + weak + "\n";
  }
  text += "clicks scatter by " + fixed(uncertainty.click_px, 2) + " px" + (uncertainty.clickWasFound ? " (found from " + std::to_string(uncertainty.freedom) + " numbers)" : "") + "\n";
  if (uncertainty.scaleShare > 0) text += "size known to +-" + fixed(100 * uncertainty.scaleShare, 2) + " %\n";
  for (const SuspectClick& suspect : suspects)
    text += "suspect: node " + std::to_string(suspect.node.value) + " in view " + suspect.view + ", " + fixed(suspect.off_px, 1) + " px off, wrong with a chance of " +
            fixed(100 * suspect.chance, 0) + " %\n";
  for (const IncompleteNode& node : skeleton.incomplete)
    text += "waits: node " + std::to_string(node.id.value) + (node.views.empty() ? " has no click that can be trusted" : " is clicked in view " + node.views.front() + " only") + "\n";
  for (const StemId stem : skeleton.waiting) text += "waits: stem " + std::to_string(stem.value) + "\n";
  for (const std::string& note : notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace axil::skeleton3d
