#include "keywords/keywords.hpp"
#include "organs/leaf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace axil::keywords {
namespace {

Presets presetsFor(std::string_view text) {
  const Result<Traits> traits = readTraits(text);
  EXPECT_TRUE(traits) << traits.error().message;
  return traits ? presetsOf(*traits) : Presets{};
}

TEST(PresetsOf, SetsWhatTheTextSaysAndNothingElse) {
  const Presets presets = presetsFor("Leaves opposite, ovate, 3-8 cm long, 20 mm wide.");
  ASSERT_TRUE(presets.arrangement);
  EXPECT_EQ(presets.arrangement->name, "opposite");
  EXPECT_EQ(presets.arrangement->leavesPerNode, 2);
  EXPECT_EQ(presets.leafShape, "ovate");
  ASSERT_TRUE(presets.leafLength_m && presets.leafWidth_m);
  EXPECT_NEAR(*presets.leafLength_m, 0.055, 1e-12);
  EXPECT_NEAR(*presets.leafWidth_m, 0.020, 1e-12);
  EXPECT_EQ(presets.evidence.at("leafLength_m"), "3-8 cm long");
  const Presets flowers = presetsFor("Flowers white.");
  EXPECT_FALSE(flowers.arrangement || flowers.leafLength_m);
  EXPECT_EQ(flowers.flower.colour, "white");
  EXPECT_EQ(flowers.leaf, LeafPreset{});
  EXPECT_EQ(flowers.evidence, (std::map<std::string, std::string>{{"flower.colour", "white"}}));
}

TEST(PresetsOf, TheMorePreciseArrangementCounts) {
  EXPECT_EQ(presetsFor("Leaves opposite, decussate.").arrangement->name, "decussate");
  EXPECT_EQ(presetsFor("葉互生,排成二列。").arrangement->name, "distichous");
  EXPECT_EQ(presetsFor("Leaves opposite, rarely alternate.").arrangement->name, "opposite");
  EXPECT_EQ(presetsFor("Leaves rarely alternate, opposite.").arrangement->name, "opposite");
}

TEST(PresetsOf, WhorlsTakeTheirNumber) {
  const Presets presets = presetsFor("Leaves whorled, 4 leaves per node.");
  EXPECT_EQ(presets.arrangement->leavesPerNode, 4);
  EXPECT_NEAR(presets.arrangement->divergence.degrees(), 45, 1e-12);
  EXPECT_EQ(presets.evidence.at("leavesPerNode"), "4 leaves per node");
  EXPECT_EQ(presetsFor("五葉輪生。").arrangement->leavesPerNode, 5);
}

TEST(PresetsOf, OtherOrgansSetNothingForTheLeaf) {
  const Presets presets = presetsFor("Petals obovate, 2 cm long; bracts opposite.");
  EXPECT_FALSE(presets.arrangement || presets.leafLength_m);
  EXPECT_EQ(presets.leafShape, "");
  EXPECT_EQ(presets.leaf, LeafPreset{});
  EXPECT_EQ(presets.flower.petalShape, "obovate");
}

TEST(PresetsOf, EveryPresetSaysWhichWordsItComesFrom) {
  const std::string text =
      "Shrub 1-3 m tall; branches at an angle of 40-60 degrees. Leaves odd-pinnate; petiole 2-3 cm; leaflets 3-5 pairs, ovate, serrate, 2-4 cm. Flowers 5-merous, white, in panicles (8-)10-20(-25) cm "
      "long; corolla funnelform. Berry globose, red, 5 mm in diameter.";
  const Presets presets = presetsFor(text);
  EXPECT_EQ(presets.leaf.type, "odd-pinnate");
  ASSERT_TRUE(presets.leaf.leaflets && presets.plant.branchAngle_deg && presets.flower.inflorescenceLength_m && presets.fruit.diameter_m);
  EXPECT_EQ(presets.leaf.leaflets->low, 7) << "three pairs and one at the end";
  EXPECT_EQ(presets.plant.branchAngle_deg->middle(), 50);
  EXPECT_NEAR(presets.flower.inflorescenceLength_m->minimum, 0.08, 1e-12);
  EXPECT_NEAR(presets.flower.inflorescenceLength_m->maximum, 0.25, 1e-12);
  EXPECT_EQ(presets.flower.form, "funnelform");
  EXPECT_EQ(presets.fruit.form, "berry");
  EXPECT_GT(presets.evidence.size(), 12u);
  for (const auto& [name, words] : presets.evidence) {
    const PresetEvidence place = presets.places.at(name);
    EXPECT_EQ(text.substr(place.start, place.end - place.start), words) << name;
  }
}

TEST(ArrangementNamed, KnowsEveryNameAndWord) {
  for (const std::string& name : arrangementNames()) {
    ASSERT_TRUE(arrangementNamed(name)) << name;
    EXPECT_EQ(arrangementNamed(name)->name, name);
  }
  EXPECT_EQ(arrangementNamed("輪生")->name, "whorled");
  EXPECT_EQ(arrangementNamed("Opposite")->name, "opposite");
  EXPECT_EQ(arrangementNamed("whorled 6")->leavesPerNode, 6);
  EXPECT_NEAR(arrangementNamed("whorled 6")->divergence.degrees(), 30, 1e-12);
  EXPECT_FALSE(arrangementNamed("sideways"));
  EXPECT_FALSE(arrangementNamed(""));
  EXPECT_FALSE(arrangementNamed("whorled 0"));
}

TEST(ArrangementNamed, CarriesTheNumbersOfTheTable) {
  EXPECT_NEAR(arrangementNamed("distichous")->divergence.degrees(), 180, 1e-12);
  EXPECT_NEAR(arrangementNamed("tristichous")->divergence.degrees(), 120, 1e-12);
  EXPECT_NEAR(arrangementNamed("spiral")->divergence.degrees(), 137.508, 1e-3);
  EXPECT_NEAR(arrangementNamed("decussate")->divergence.degrees(), 90, 1e-12);
  EXPECT_NEAR(arrangementNamed("spirally decussate")->divergence.degrees(), 68.75, 1e-2);
  EXPECT_NEAR(arrangementNamed("opposite superposed")->divergence.degrees(), 0, 1e-12);
  EXPECT_NEAR(arrangementNamed("pentastichous")->divergence.degrees(), 144, 1e-12);
  EXPECT_NEAR(arrangementNamed("octastichous")->divergence.degrees(), 135, 1e-12);
  const auto degreesOf = [](const std::vector<Angle>& cycle) {
    std::vector<long> degrees;
    for (const Angle turn : cycle) degrees.push_back(std::lround(turn.degrees()));
    return degrees;
  };
  EXPECT_EQ(degreesOf(arrangementNamed("orixate")->cycle), (std::vector<long>{180, 90, 180, 270}));
  EXPECT_EQ(degreesOf(arrangementNamed("beech-like")->cycle), (std::vector<long>{90, 270}));
  EXPECT_TRUE(arrangementNamed("opposite")->cycle.empty());
  EXPECT_TRUE(arrangementNamed("rosette")->clustered);
  EXPECT_FALSE(arrangementNamed("alternate")->clustered);
}

TEST(DrawnShapeOf, EveryFlatShapeOfTheVocabularyCanBeDrawn) {
  for (const Concept& shape : categoryOf("shape").concepts)
    EXPECT_EQ(organs::leafShapeNamed(drawnShapeOf(shape.name)).has_value(), shape.columns.contains("shape")) << shape.name;
  EXPECT_EQ(drawnShapeOf("globose"), "") << "a body has no outline";
  EXPECT_EQ(drawnShapeOf("ovate-lanceolate"), "lanceolate");
  EXPECT_EQ(drawnShapeOf("unheard"), "");
}

TEST(Vocabulary, HasThreeScriptsForEveryConceptAndNoNameTwice) {
  for (const Category& category : vocabulary()) {
    std::set<std::string> names;
    for (const Concept& entry : category.concepts) {
      EXPECT_TRUE(names.insert(entry.name).second) << category.property << " " << entry.name;
      EXPECT_FALSE(entry.english.empty()) << entry.name;
      EXPECT_FALSE(entry.traditional.empty()) << entry.name;
      EXPECT_FALSE(entry.simplified.empty()) << entry.name;
      EXPECT_FALSE(entry.definition.empty()) << entry.name;
    }
  }
}

TEST(TraitsJson, IsWhatTheFileFormatSays) {
  const std::string text = "Leaves ovate, 3-8 cm long.";
  const Result<Traits> traits = readTraits(text);
  ASSERT_TRUE(traits);
  EXPECT_EQ(traitsJson(*traits, presetsOf(*traits)), R"({
  "traits": [
    {
      "organ": "leaf",
      "property": "shape",
      "organ_id": "PO:0025034",
      "value": "ovate",
      "id": "PATO:0001891",
      "text": "ovate",
      "start": 7,
      "end": 12
    },
    {
      "organ": "leaf",
      "property": "length",
      "organ_id": "PO:0025034",
      "low": 3,
      "high": 8,
      "unit": "cm",
      "text": "3-8 cm long",
      "start": 14,
      "end": 25
    }
  ],
  "presets": {
    "leafShape": "ovate",
    "leafLength_m": 0.055,
    "leaf": {
      "length_m": {
        "minimum": 0.03,
        "low": 0.03,
        "high": 0.08,
        "maximum": 0.08
      }
    },
    "evidence": {
      "leaf.length_m": "3-8 cm long",
      "leafLength_m": "3-8 cm long",
      "leafShape": "ovate"
    },
    "places": {
      "leaf.length_m": [
        14,
        25
      ],
      "leafLength_m": [
        14,
        25
      ],
      "leafShape": [
        7,
        12
      ]
    }
  }
}
)");
  EXPECT_NE(traitsJson({}, {}).find("\"traits\": []"), std::string::npos);
}

TEST(TraitsText, NamesEveryTraitWithItsWords) {
  const Result<Traits> traits = readTraits("Leaves opposite.");
  ASSERT_TRUE(traits);
  const std::string text = traitsText(*traits, presetsOf(*traits));
  EXPECT_NE(text.find("arrangement"), std::string::npos);
  EXPECT_NE(text.find("\"opposite\" at 7-15"), std::string::npos);
}

}  // namespace
}  // namespace axil::keywords
