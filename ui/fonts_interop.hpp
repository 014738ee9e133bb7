#pragma once
/// \file
/// Private to ui: the fonts. Chinese has some 20,000 characters, far too many to draw at every size when the window opens; so only those
/// that are shown are drawn, and the fonts are made anew when others come up.

#include "base/result.hpp"

#include <bitset>
#include <string_view>

namespace axil::ui {

class FontBook {
 public:
  /// Notes what is shown; bytes that are no UTF-8 are passed over.
  void want(std::string_view text);
  /// Makes the fonts anew where something new is wanted or `scale` has changed; true when it did, and the texture must be sent again.
  bool prepare(float scale);
  /// Where the fonts were not found.
  [[nodiscard]] static bool isInstalled();

 private:
  std::bitset<65536> wanted_;
  bool isNew_ = true;
  float scale_ = 0;
};

}  // namespace axil::ui
