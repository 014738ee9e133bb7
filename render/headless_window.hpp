#pragma once
/// \file
/// Private to render: a window that is nowhere. A drawing context without display, X server or rights (EGL, on the
/// processor where there is no graphics card), and VTK's window on it.
///
/// One thread opens it and draws with it; that thread must have no other drawing context of its own (a desktop window's),
/// so a program with a window draws its pictures on another thread.

#include "base/result.hpp"

#include <cstdint>
#include <memory>
#include <vector>

class vtkRenderer;

namespace axil::render {

struct DrawSize {
  int width_px = 0;
  int height_px = 0;
  int edgeSamples = 0;  ///< samples of a pixel at the edges of triangles; 0: its middle alone
};

class HeadlessWindow {
 public:
  /// Fails with NoAnswer where the machine has no EGL with OpenGL 3.2.
  [[nodiscard]] static Result<HeadlessWindow> open();
  HeadlessWindow(HeadlessWindow&&) noexcept;
  HeadlessWindow& operator=(HeadlessWindow&&) noexcept;
  ~HeadlessWindow();

  /// Draws what `renderer` holds and gives the pixels: RGBA, rows from the bottom. What was sent to the graphics memory
  /// stays there for the next time, until `forget`.
  [[nodiscard]] Result<std::vector<std::uint8_t>> draw(vtkRenderer& renderer, const DrawSize& size);
  void forget(vtkRenderer& renderer);

 private:
  struct Inside;
  explicit HeadlessWindow(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace axil::render
