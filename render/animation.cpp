#include "render/animation.hpp"

#include "base/files.hpp"
#include "base/text.hpp"
#include "render/obstacles.hpp"
#include "render/webm.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <optional>

namespace axil::render {
namespace {

enum class Form { Folder, Mp4, Webm };

Form formOf(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".mp4" ? Form::Mp4 : ending == ".webm" ? Form::Webm : Form::Folder;
}

Result<void> checkOptions(const AnimationOptions& options, Form form) {
  if (!std::isfinite(options.from) || !std::isfinite(options.to) || options.from > options.to)
    return fail(ErrorCode::BadInput, "growth cannot be shown from time " + shortest(options.from) + " to " + shortest(options.to) + "; the end must not come before the start");
  if (options.frames < 2 || options.frames > maximumFrames)
    return fail(ErrorCode::BadInput, "an animation cannot have " + std::to_string(options.frames) + " frames; choose 2 to " + std::to_string(maximumFrames));
  if (form == Form::Folder) return {};
  if (!(options.framesPerSecond >= 1 && options.framesPerSecond <= 240))
    return fail(ErrorCode::BadInput, "a video cannot show " + shortest(options.framesPerSecond) + " frames a second; choose 1 to 240");
  if (options.picture.width_px % 2 == 0 && options.picture.height_px % 2 == 0) return {};
  return fail(ErrorCode::BadInput, "a video of " + std::to_string(options.picture.width_px) + " x " + std::to_string(options.picture.height_px) +
                                       " pixels cannot be coded; make both sides even");
}

double timeOf(const AnimationOptions& options, int frame) {
  if (frame + 1 == options.frames) return options.to;
  return options.from + (options.to - options.from) * frame / (options.frames - 1);
}

/// The picture options of every frame: the camera and the floor of the grown plant.
Result<PictureOptions> steadyPicture(const GrowthAt& growthAt, const AnimationOptions& options) {
  PictureOptions picture = options.picture;
  const auto* preset = std::get_if<ViewPreset>(&picture.view);
  if (preset == nullptr && picture.floorHeight) return picture;
  const auto plant = growthAt(options.to);
  if (!plant) return plant.failure();
  const auto mesh = meshOf(*plant);
  if (!mesh) return mesh.failure();
  if (!picture.floorHeight) picture.floorHeight = floorUnder(*mesh);
  if (preset != nullptr) picture.view = cameraFitting(withObstacles(*mesh, obstaclesToFrame(*mesh, picture.obstacles)), *preset, picture.width_px, picture.height_px);
  return picture;
}

using TakeFrame = std::function<Result<void>(int frame, const Image& image)>;

Result<void> drawFrames(const GrowthAt& growthAt, const AnimationOptions& options, const Watch& watch, const TakeFrame& take) {
  const auto picture = steadyPicture(growthAt, options);
  if (!picture) return picture.failure();
  auto painter = Painter::open();
  if (!painter) return painter.failure();
  for (int frame = 0; frame < options.frames; ++frame) {
    if (watch.cancelled()) return fail(ErrorCode::Cancelled, "the animation was stopped at frame " + std::to_string(frame + 1) + " of " + std::to_string(options.frames));
    watch.report("drawing frames", static_cast<double>(frame) / options.frames);
    const auto plant = growthAt(timeOf(options, frame));
    if (!plant) return plant.failure();
    const auto mesh = meshOf(*plant);
    if (!mesh) return mesh.failure();
    const auto image = painter->draw(*mesh, *picture);
    if (!image) return image.failure();
    if (const auto taken = take(frame, *image); !taken) return taken;
  }
  watch.report("drawing frames", 1);
  return {};
}

std::string frameName(int frame) {
  std::string number = std::to_string(frame + 1);
  if (number.size() < 4) number.insert(0, 4 - number.size(), '0');
  return "frame_" + number + ".png";
}

/// OpenCV writes past every setting of its log to the terminal that it looks for a tag of VP8 which WebM does not have. While
/// this lives, nothing reaches the terminal's error stream.
class Hush {
 public:
  Hush() : kept_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) ::close(nowhere);
  }
  Hush(const Hush&) = delete;
  Hush& operator=(const Hush&) = delete;
  ~Hush() {
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }

 private:
  int kept_;
};

/// A video that OpenCV writes; it throws or says nothing when it cannot.
class Video {
 public:
  [[nodiscard]] static Result<Video> open(const std::filesystem::path& path, Form form, const AnimationOptions& options) {
    const int code = form == Form::Mp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1') : cv::VideoWriter::fourcc('V', 'P', '8', '0');
    Video video;
    const Hush hush;
    try {
      video.writer_.open(path.string(), cv::CAP_FFMPEG, code, options.framesPerSecond, {options.picture.width_px, options.picture.height_px});
    } catch (const cv::Exception&) {
    }
    if (video.writer_.isOpened()) return video;
    return fail(ErrorCode::NoAnswer, std::string("this machine's OpenCV cannot write ") + (form == Form::Mp4 ? "H.264 in .mp4" : "VP8 in .webm") +
                                         "; install OpenCV with FFmpeg, or write a folder of PNGs");
  }

  [[nodiscard]] Result<void> add(const Image& image) {
    try {
      cv::Mat bgr;
      const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
      cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
      writer_.write(bgr);
    } catch (const cv::Exception&) {
      return fail(ErrorCode::Unwritable, "a frame of the video could not be written");
    }
    return {};
  }

  void close() { writer_.release(); }

 private:
  cv::VideoWriter writer_;
};

Result<void> writeFolder(const std::filesystem::path& path, const GrowthAt& growthAt, const AnimationOptions& options, const Watch& watch) {
  auto staging = StagingFolder::beside(path);
  if (!staging) return staging.failure();
  const auto drawn = drawFrames(growthAt, options, watch,
                                [&](int frame, const Image& image) { return writePng(staging->path() / frameName(frame), image); });
  if (!drawn) return drawn;
  return staging->publish();
}

Result<void> writeVideo(const std::filesystem::path& path, Form form, const GrowthAt& growthAt, const AnimationOptions& options, const Watch& watch) {
  // Never published: it holds the file while it grows.
  const auto staging = StagingFolder::beside(path.string() + ".parts");
  if (!staging) return staging.failure();
  const std::filesystem::path aside = staging->path() / path.filename();
  auto video = Video::open(aside, form, options);
  if (!video) return video.failure();
  const auto drawn = drawFrames(growthAt, options, watch, [&](int, const Image& image) { return video->add(image); });
  video->close();
  if (!drawn) return drawn;
  auto bytes = readFile(aside, std::uintmax_t{1} << 36);
  if (!bytes) return bytes.failure();
  if (bytes->empty()) return fail(ErrorCode::Unwritable, "the video " + path.string() + " came out empty; is the disk full?");
  return writeFile(path, form == Form::Webm ? withFixedIds(std::move(*bytes)) : *bytes);
}

}  // namespace

Result<void> writeAnimation(const std::filesystem::path& path, const GrowthAt& growthAt, const AnimationOptions& options, const Watch& watch) {
  const Form form = formOf(path);
  if (const auto checked = checkOptions(options, form); !checked) return checked;
  if (form == Form::Folder) return writeFolder(path, growthAt, options, watch);
  return writeVideo(path, form, growthAt, options, watch);
}

}  // namespace axil::render
