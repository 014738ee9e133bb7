#pragma once
/// \file
/// A drawing context that is nowhere: OpenGL without display, X server or rights (EGL; on the processor where there is no graphics card).
/// What is drawn goes into framebuffers that the user of it makes.

#include "base/result.hpp"

#include <memory>

namespace axil::render {

class DrawingContext {
 public:
  /// Current on the calling thread, which must have no other drawing context. Fails with NoAnswer where the machine has no EGL with OpenGL 3.2.
  [[nodiscard]] static Result<DrawingContext> open();
  DrawingContext(DrawingContext&&) noexcept;
  DrawingContext& operator=(DrawingContext&&) noexcept;
  ~DrawingContext();

  /// On the calling thread, again.
  [[nodiscard]] bool makeCurrent() const;

 private:
  struct Inside;
  explicit DrawingContext(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace axil::render
