#include "simeco/vocabulary.hpp"

namespace axil::simeco {

namespace {

constexpr AttributeWord kAttributes[] = {
    // The whole ecosystem; a plant may say its own.
    {"SoilPH", InEcosystem | InPlant, ValueKind::Number, false, {}},
    {"RainRate", InEcosystem | InPlant, ValueKind::NotNegative, false, {}},
    {"DayLight", InEcosystem | InPlant, ValueKind::NotNegative, false, {}},
    {"SoilPHWidth", InEcosystem | InPlant, ValueKind::Positive, true, {}},
    {"RainRateWidth", InEcosystem | InPlant, ValueKind::Positive, true, {}},
    {"DayLightWidth", InEcosystem | InPlant, ValueKind::Positive, true, {}},
    {"Temperature", InEcosystem | InPlant, ValueKind::Number, true, {}},
    {"TemperatureWidth", InEcosystem | InPlant, ValueKind::Positive, true, {}},
    {"SoilPHBest", InEcosystem | InPlant, ValueKind::Number, true, {}},
    {"RainRateBest", InEcosystem | InPlant, ValueKind::Number, true, {}},
    {"DayLightBest", InEcosystem | InPlant, ValueKind::Number, true, {}},
    {"TemperatureBest", InEcosystem | InPlant, ValueKind::Number, true, {}},
    {"Light", InEcosystem | InPlant, ValueKind::Vector, true, {}},
    {"Gravity", InEcosystem | InPlant, ValueKind::Vector, true, {}},
    {"Wind", InEcosystem | InPlant, ValueKind::Vector, true, {}},
    {"Obstacle", InEcosystem, ValueKind::Body, true, {}},
    // A plant.
    {"Position", InPlant, ValueKind::Vector, false, {}},
    {"Direction", InPlant, ValueKind::Vector, false, {}},
    {"DeriveTime", InPlant, ValueKind::Positive, false, {}},
    // Organs: of all stages, or of one.
    {"Model", InOrgan, ValueKind::Words, false, {}},
    {"TextureFront", InOrgan, ValueKind::Words, false, {}},
    {"TextureBack", InOrgan, ValueKind::Words, false, {}},
    {"GrowRate", InOrgan, ValueKind::NotNegative, false, {}},
    {"GrowTime", InOrgan, ValueKind::NotNegative, false, {}},
    {"BroadenRate", InOrgan, ValueKind::NotNegative, false, {}},
    {"ColorFront", InOrgan, ValueKind::Colour, false, {}},
    {"ColorBack", InOrgan, ValueKind::Colour, false, {}},
    {"MaterialFront", InOrgan, ValueKind::Material, false, {}},
    {"MaterialBack", InOrgan, ValueKind::Material, false, {}},
    // How organs bend.
    {"Tropism", InPlant | InOrgan, ValueKind::Vector, true, {}},
    {"GravityTropism", InPlant | InOrgan, ValueKind::Number, true, {}},
    {"LightTropism", InPlant | InOrgan, ValueKind::Number, true, {}},
    {"WindTropism", InPlant | InOrgan, ValueKind::Number, true, {}},
    {"Elasticity", InPlant | InOrgan, ValueKind::NotNegative, true, {}},
    {"LightResponse", InPlant | InOrgan, ValueKind::NotNegative, true, {}},
    // How they age.
    {"BroadenTime", InOrgan, ValueKind::NotNegative, true, {}},
    {"UnfoldTime", InOrgan, ValueKind::NotNegative, true, {}},
    {"WitherAge", InOrgan, ValueKind::NotNegative, true, {}},
    {"WitherTime", InOrgan, ValueKind::NotNegative, true, {}},
    {"WitherColor", InOrgan, ValueKind::Colour, true, {}},
    {"FallAge", InOrgan, ValueKind::NotNegative, true, {}},
};

constexpr FunctionWord kFunctions[] = {
    {"vector", 3, 3, false}, {"RGBA", 4, 4, false},  {"MTRL", 6, 6, false},  {"sphere", 4, 4, true},  {"box", 6, 6, true},  {"sin", 1, 1, true},   {"cos", 1, 1, true},
    {"tan", 1, 1, true},     {"asin", 1, 1, true},   {"acos", 1, 1, true},   {"atan", 1, 1, true},  {"atan2", 2, 2, true},
    {"exp", 1, 1, true},     {"log", 1, 1, true},    {"sqrt", 1, 1, true},   {"abs", 1, 1, true},   {"floor", 1, 1, true},
    {"ceil", 1, 1, true},    {"round", 1, 1, true},  {"min", 2, 2, true},    {"max", 2, 2, true},   {"pow", 2, 2, true},
    {"sign", 1, 1, true},    {"random", 2, 2, true}, {"normal", 2, 2, true}, {"func", 1, -1, true}, {"com", 1, -1, true},
};

// An organ's first argument is its stage; the further ones of version 1.1 are the author's own.
constexpr LetterWord kLetters[] = {
    {"A", 1, 20, false},   {"S", 1, 20, false},   {"L", 1, 20, false}, {"R", 1, 20, false}, {"F", 1, 20, false}, {"W", 1, 20, false},
    {"rotr", 1, 1, false}, {"rotu", 1, 1, false}, {"[", 0, 0, false},  {"]", 0, 0, false},  {"?E", 0, 20, true},  // answered by the program
                                                                                                                  // around the engine
    {"%", 0, 0, true},  // cuts the rest of its branch
};

}  // namespace

std::span<const AttributeWord> attributeWords() { return kAttributes; }

std::span<const FunctionWord> functionWords() { return kFunctions; }

std::span<const LetterWord> letterWords() { return kLetters; }

std::optional<OrganKind> organOfKeyword(std::string_view word) {
  for (const OrganKind kind : {OrganKind::Apex, OrganKind::Stem, OrganKind::Leaf, OrganKind::Root, OrganKind::Fruit, OrganKind::Flower})
    if (word == keywordOf(kind)) return kind;
  return std::nullopt;
}

}  // namespace axil::simeco
