#pragma once
/// \file
/// Inflorescences as small grammars: the stages and rules, in SimEco 1.1, by which an apex becomes a raceme, an umbel, a head. Each stands
/// alone (`inflorescenceGrammar`, for looking at) or is a part of a described plant's grammar. Lengths in metres.
///
/// Apices from `firstApex` and stages from `firstStage` on are the inflorescence's own; A(firstApex) is what turns into it.

#include "base/result.hpp"
#include "simeco/grammar.hpp"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::emit {

enum class InflorescenceType { Solitary, Raceme, Spike, Panicle, Corymb, Umbel, CompoundUmbel, Head, Cyme, Catkin, Spadix, Fascicle };

/// By the vocabulary's words ("raceme", "compound umbel", "thyrse"); nothing for a word that is none.
[[nodiscard]] std::optional<InflorescenceType> inflorescenceNamed(std::string_view name);
/// The words, one a type, in the order of the types.
[[nodiscard]] std::vector<std::string> inflorescenceNames();

/// What a flower becomes when it is over.
struct FruitPlan {
  std::string model;                      ///< empty: it sets no fruit
  double length = 0.01;                   ///< along the stalk
  double width = 0.01;
  std::optional<glm::dvec3> colour;       ///< sRGB
  int bloom = 6;                          ///< steps that a flower lasts
};

struct InflorescencePlan {
  InflorescenceType type = InflorescenceType::Solitary;
  int flowers = 0;                        ///< 0: as many as is usual for the type
  double length = 0;                      ///< of the whole, peduncle excluded; 0: as its flowers need
  double flowerLength = 0.02;             ///< of one flower along its axis and a petal
  double flowerWidth = 0.02;              ///< across
  std::string flowerModel = "five-petalled";
  FruitPlan fruit = {};
  double stepTime = 1;                    ///< of the grammar it is for: the time of one derivation step
  double metre = 1;                       ///< and the length of a metre there
  std::vector<glm::dvec3> colours;        ///< sRGB; heads and umbels carry several from the outside inwards, others the first
};

/// Stages and rules as SimEco text, to be put into a plant's blocks.
struct InflorescenceText {
  std::string stemStages;
  std::string leafStages;
  std::string flowerStages;
  std::string fruitStages;
  std::string rules;
  std::string decomposition;  ///< rules that run within a step: what stands at one place appears at once
  int steps = 1;              ///< derivation steps from its apex to its last flower
  int ripening = 0;           ///< further steps until all its fruits are ripe; 0 without any
};
[[nodiscard]] InflorescenceText inflorescenceText(const InflorescencePlan& plan, int firstApex, int firstStage);

/// The inflorescence alone, on a stalk; its apices and stages are numbered from these on, so that it can be taken into another plant.
[[nodiscard]] Result<simeco::Grammar> inflorescenceGrammar(const InflorescencePlan& plan, int firstApex = 10, int firstStage = 1);

}  // namespace axil::emit
