#pragma once
/// \file
/// From presets to the names of organ models (organs/model.hpp): what a description says about a leaf, a flower or a fruit, in the words
/// that a grammar's Model carries: "ovate, apex acuminate, base cordate, margin serrate". What the text does not say is left out; a
/// word that no table of organs has is left out too.

#include "keywords/types.hpp"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::keywords {

/// Each is empty where the text says nothing about how the organ is made. `traits` are those that `presets` come from; spots are
/// read from them.
[[nodiscard]] std::string leafModelOf(const Traits& traits, const Presets& presets);
[[nodiscard]] std::string flowerModelOf(const Traits& traits, const Presets& presets);
[[nodiscard]] std::string fruitModelOf(const Presets& presets);

/// A colour of the vocabulary as sRGB from 0 to 1.
[[nodiscard]] std::optional<glm::dvec3> colourNamed(std::string_view name);
/// The colours that the text gives a blade, a flower (its corolla or petals) or a fruit, in its order; "dark" and "pale" before the
/// word count. Spots are no colour of the blade.
[[nodiscard]] std::vector<glm::dvec3> leafColours(const Traits& traits);
[[nodiscard]] std::vector<glm::dvec3> flowerColours(const Traits& traits);
[[nodiscard]] std::vector<glm::dvec3> fruitColours(const Traits& traits);

}  // namespace axil::keywords
