#pragma once
/// \file
/// Animations: a plant's growth as a folder of PNGs (frame_0001.png, ...), or a video: .mp4 (H.264) or .webm (VP8).
///
/// The camera stands still: it fits the plant at the end of the time, unless a camera is given. Everything is written
/// aside and put into its place when it is complete, so a stopped or failed run leaves nothing behind.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "render/picture.hpp"

#include <filesystem>
#include <functional>

namespace axil::render {

/// The plant at a time of its grammar.
using GrowthAt = std::function<Result<simeco::Plant>(double time)>;

struct AnimationOptions {
  double from = 0;             ///< time of the first frame, in the grammar's time
  double to = 1;               ///< time of the last
  int frames = 100;            ///< at least 2
  double framesPerSecond = 25; ///< of a video
  PictureOptions picture{.width_px = 720, .height_px = 960};
};

inline constexpr int maximumFrames = 100'000;

/// Writes what `path`'s ending says; no ending or an unknown one is a folder. Fails with BadInput for options that make
/// no animation (a video needs even sides), with Unwritable where the file cannot be written, with NoAnswer where this
/// machine's OpenCV has no encoder for it, with Cancelled when told to stop, and with whatever `growthAt` fails with.
[[nodiscard]] Result<void> writeAnimation(const std::filesystem::path& path, const GrowthAt& growthAt, const AnimationOptions& options,
                                          const Watch& watch = {});

}  // namespace axil::render
