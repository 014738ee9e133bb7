#include "keywords/keywords.hpp"

#include "base/rng.hpp"
#include "base/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

namespace axil::keywords {
namespace {

// "leaf arrangement opposite", "leaf length 3-8 cm": a trait in short.
std::string inShort(const Trait& trait) {
  std::string text = trait.organ + " " + trait.property + " ";
  if (!trait.value.empty()) return text + trait.value;
  if (trait.low) text += shortest(*trait.low);
  if (trait.high && trait.low != trait.high) text += (trait.low ? "-" : "..") + shortest(*trait.high);
  return trait.unit.empty() ? text : text + " " + trait.unit;
}

std::vector<std::string> traitsOf(std::string_view text) {
  const Result<Traits> traits = readTraits(text);
  EXPECT_TRUE(traits) << traits.error().message;
  std::vector<std::string> all;
  if (traits)
    for (const Trait& trait : *traits) all.push_back(inShort(trait));
  return all;
}

using Lines = std::vector<std::string>;

TEST(ReadTraits, FindsArrangementAndShapeInThreeScripts) {
  const Lines expected{"leaf arrangement opposite", "leaf shape ovate"};
  EXPECT_EQ(traitsOf("Leaves opposite, ovate."), expected);
  EXPECT_EQ(traitsOf("葉對生,卵形。"), expected);
  EXPECT_EQ(traitsOf("叶对生，卵形。"), expected);
}

TEST(ReadTraits, ReadsAdjectivesBeforeTheirOrgan) {
  EXPECT_EQ(traitsOf("A shrub with opposite, broadly ovate leaves."), (Lines{"plant life form shrub", "leaf arrangement opposite", "leaf shape ovate"}));
  EXPECT_EQ(traitsOf("Flowers with lanceolate petals."), (Lines{"petal shape lanceolate"}));
  EXPECT_EQ(traitsOf("具對生的葉。"), (Lines{"leaf arrangement opposite"}));
}

TEST(ReadTraits, GivesAStatementToTheOrganNamedBeforeIt) {
  EXPECT_EQ(traitsOf("Leaves alternate, petiole 1-2 cm long, petals obovate."),
            (Lines{"leaf arrangement alternate", "petiole length 1-2 cm", "petal shape obovate"}));
  EXPECT_EQ(traitsOf("葉互生,葉柄長1-2公分,花瓣倒卵形。"), (Lines{"leaf arrangement alternate", "petiole length 1-2 cm", "petal shape obovate"}));
}

TEST(ReadTraits, TheLongestPhraseWins) {
  EXPECT_EQ(traitsOf("葉倒披針形。"), (Lines{"leaf shape oblanceolate"}));
  EXPECT_EQ(traitsOf("葉十字對生。"), (Lines{"leaf arrangement decussate"}));
  EXPECT_EQ(traitsOf("Leaves pinnately lobed."), (Lines{"leaf shape pinnately lobed"}));
}

TEST(ReadTraits, KeepsWordsWhole) {
  EXPECT_EQ(traitsOf("Leaves subobovateish and curvilinear."), Lines{});
  EXPECT_EQ(traitsOf("Leaves OBOVATE."), (Lines{"leaf shape obovate"}));
}

TEST(ReadTraits, PartsTakeTheirShape) {
  EXPECT_EQ(traitsOf("Leaves ovate, base cordate."), (Lines{"leaf shape ovate", "leaf base cordate"}));
  EXPECT_EQ(traitsOf("Leaves ovate, cordate at the base, 3 cm long."), (Lines{"leaf shape ovate", "leaf base cordate", "leaf length 3 cm"}));
  EXPECT_EQ(traitsOf("葉卵形,基部心形。"), (Lines{"leaf shape ovate", "leaf base cordate"}));
}

TEST(ReadTraits, NegatedStatementsYieldNothing) {
  EXPECT_EQ(traitsOf("Leaves not opposite."), Lines{});
  EXPECT_EQ(traitsOf("Leaves neither opposite nor whorled, ovate."), (Lines{"leaf shape ovate"}));
  EXPECT_EQ(traitsOf("葉不對生,互生。"), (Lines{"leaf arrangement alternate"}));
  EXPECT_EQ(traitsOf("叶非对生。"), Lines{});
}

TEST(ReadTraits, RangesOfShapesAreTwoAndCompoundsAreOne) {
  EXPECT_EQ(traitsOf("Leaves ovate to lanceolate."), (Lines{"leaf shape ovate", "leaf shape lanceolate"}));
  EXPECT_EQ(traitsOf("Leaves ovate-lanceolate."), (Lines{"leaf shape ovate-lanceolate"}));
  EXPECT_EQ(traitsOf("葉卵狀披針形。"), (Lines{"leaf shape ovate-lanceolate"}));
  EXPECT_EQ(traitsOf("葉卵形至披針形。"), (Lines{"leaf shape ovate", "leaf shape lanceolate"}));
}

TEST(ReadTraits, ReadsSizes) {
  EXPECT_EQ(traitsOf("Leaves 3-8 cm long, 1.5–2 cm wide."), (Lines{"leaf length 3-8 cm", "leaf width 1.5-2 cm"}));
  EXPECT_EQ(traitsOf("Blade 23-34 × 4.5-5.6 cm."), (Lines{"leaf length 23-34 cm", "leaf width 4.5-5.6 cm"}));
  EXPECT_EQ(traitsOf("葉長 3-8 公分,寬2～4公分。"), (Lines{"leaf length 3-8 cm", "leaf width 2-4 cm"}));
  EXPECT_EQ(traitsOf("叶长３－８厘米。"), (Lines{"leaf length 3-8 cm"}));
  EXPECT_EQ(traitsOf("Shrub 2-3 m tall."), (Lines{"plant life form shrub", "plant height 2-3 m"}));
  EXPECT_EQ(traitsOf("喬木,高可達10公尺。"), (Lines{"plant life form tree", "plant height ..10 m"}));
  EXPECT_EQ(traitsOf("Leaves up to 5 mm long."), (Lines{"leaf length ..5 mm"}));
}

TEST(ReadTraits, KeepsTheExtremesInBrackets) {
  const Result<Traits> traits = readTraits("Blade (12-)23-34(-40) × 4.5-5.6 cm.");
  ASSERT_TRUE(traits);
  ASSERT_EQ(traits->size(), 2u);
  EXPECT_EQ(traits->front().minimum, 12);
  EXPECT_EQ(traits->front().low, 23);
  EXPECT_EQ(traits->front().high, 34);
  EXPECT_EQ(traits->front().maximum, 40);
  EXPECT_EQ(traits->front().text, "(12-)23-34(-40) × 4.5-5.6 cm");
  EXPECT_FALSE(traits->back().minimum);
}

TEST(ReadTraits, NeverGuessesAUnit) { EXPECT_EQ(traitsOf("Leaves 3-8 long."), Lines{}); }

TEST(ReadTraits, AltitudesAreNoHeights) { EXPECT_EQ(traitsOf("Shrubs at elevations of 300-1500 m."), Lines{"plant life form shrub"}); }

TEST(ReadTraits, ReadsCounts) {
  EXPECT_EQ(traitsOf("Petals 5, stamens 10."), (Lines{"petal count 5", "stamen count 10"}));
  EXPECT_EQ(traitsOf("Leaflets 5-8 pairs."), (Lines{"leaflet count 5-8 pairs"}));
  EXPECT_EQ(traitsOf("小葉8-12對,花瓣5枚。"), (Lines{"leaflet count 8-12 pairs", "petal count 5"}));
  EXPECT_EQ(traitsOf("Leaves whorled, 4 leaves per node."), (Lines{"leaf arrangement whorled", "leaf count 4 per node"}));
  EXPECT_EQ(traitsOf("Leaves in whorls of 3-5."), (Lines{"leaf arrangement whorled", "leaf count 3-5 per node"}));
  EXPECT_EQ(traitsOf("四葉輪生。"), (Lines{"leaf count 4 per node", "leaf arrangement whorled"}));
}

TEST(ReadTraits, DoubtfulStatementsCarryTheirQualifier) {
  const Result<Traits> traits = readTraits("Leaves opposite, rarely whorled, narrowly ovate.");
  ASSERT_TRUE(traits);
  ASSERT_EQ(traits->size(), 3u);
  EXPECT_EQ((*traits)[0].qualifier, "");
  EXPECT_EQ((*traits)[1].qualifier, "rarely");
  EXPECT_EQ((*traits)[2].qualifier, "narrowly");
}

TEST(ReadTraits, InventsNothingInTextThatIsNotAboutPlants) {
  for (const char* text : {"He leaves the house opposite the station.", "The opposite is true.", "A round table, 2 m long, in an oblong room.",
                           "結果他走了3公尺。", "雙方根據協議輪流發言。", "A linear model alternates with a spiral one.",
                           "The old tree at the door was round and green.", "他的牙齒很白，直立在圓形的門口。"})
    EXPECT_EQ(traitsOf(text), Lines{}) << text;
}

TEST(ReadTraits, CountsPlacesInBytesAndCharacters) {
  const std::string text = "又見。葉對生，卵形";
  const Result<Traits> traits = readTraits(text);
  ASSERT_TRUE(traits);
  ASSERT_EQ(traits->size(), 2u);
  EXPECT_EQ(traits->front().start, 4u);
  EXPECT_EQ(traits->front().end, 6u);
  EXPECT_EQ(traits->front().span, (SourceSpan{12, 18}));
  EXPECT_EQ(traits->front().text, "對生");
}

// Pieces of descriptions, noise and broken sentences in any order: whatever is read quotes exactly what stands there.
std::string randomText(Rng& rng) {
  const std::vector<std::string> pieces{"Leaves ", "opposite", "葉", "對生", "卵狀", "披針形", ", ", "。", "; ", "ovate-", "lanceolate ", "3-8 cm ", "× ", "２～４公分", "\n", "\n\n",
                                        "(2-)3(-5) ", "not ", "不", "base ", "cordate ", "petals 5 ", "à", "🌿", "whorls of 4 ", "- ", "(", "高達", "10 m tall ", ". ", "小葉8-12對 "};
  std::string text;
  const std::uint64_t count = 1 + rng.below(40);
  for (std::uint64_t i = 0; i < count; ++i) text += pieces[rng.below(pieces.size())];
  return text;
}

TEST(ReadTraits, EverySpanQuotesItsTextExactly) {
  std::size_t read = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng rng(seed);
    const std::string text = randomText(rng);
    const Result<Traits> traits = readTraits(text);
    if (!traits) continue;  // nothing but blanks
    for (const Trait& trait : *traits) {
      ++read;
      ASSERT_LT(trait.span.begin, trait.span.end) << seed;
      ASSERT_LE(trait.span.end, text.size()) << seed;
      ASSERT_EQ(text.substr(trait.span.begin, trait.span.end - trait.span.begin), trait.text) << seed;
      ASSERT_EQ(trait.start, countCharacters(std::string_view(text).substr(0, trait.span.begin))) << seed;
      ASSERT_EQ(trait.end, countCharacters(std::string_view(text).substr(0, trait.span.end))) << seed;
    }
  }
  EXPECT_GT(read, 5000u);
}

TEST(ReadTraits, RefusesWhatIsNoDescription) {
  for (const std::string& text : {std::string(), std::string(" \n\t "), std::string("a\0b", 3), std::string("\x89PNG\r\n\x1a\n\x00\x80", 10), std::string("\x01\x02\x03\x04leaf\x05\x06")}) {
    const Result<Traits> traits = readTraits(text);
    ASSERT_FALSE(traits);
    EXPECT_EQ(traits.error().code, ErrorCode::BadInput);
    EXPECT_FALSE(traits.error().message.empty());
  }
}

TEST(ReadTraits, AFileCutOffInsideACharacterIsStillRead) {
  const std::string whole = "葉對生，卵形，全緣";
  for (const std::size_t cut : {1u, 2u}) {
    const Result<Traits> traits = readTraits(std::string_view(whole).substr(0, whole.size() - cut));
    ASSERT_TRUE(traits) << traits.error().message;
    ASSERT_EQ(traits->size(), 2u);
    EXPECT_EQ((*traits)[0].value, "opposite");
    EXPECT_EQ((*traits)[1].value, "ovate");
  }
}

TEST(ReadTraits, StatesItsLimit) {
  const std::string text(descriptionLimitBytes + 1, 'a');
  const Result<Traits> traits = readTraits(text);
  ASSERT_FALSE(traits);
  EXPECT_EQ(traits.error().code, ErrorCode::LimitReached);
}

TEST(ReadTraits, AnEndlessLineIsReadToItsEndInLinearTime) {
  const auto secondsFor = [](std::size_t bytes) {
    std::string text;
    while (text.size() < bytes) text += "葉對生卵形";
    const std::clock_t begin = std::clock();  // processor time: other programs do not count
    const Result<Traits> traits = readTraits(text);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_TRUE(traits);
    // A block may cut one statement in two; it loses no more than that.
    EXPECT_NEAR(static_cast<double>(traits->size()), 2.0 * static_cast<double>(text.size()) / 15, 2.0 * static_cast<double>(text.size()) / 65000 + 2);
    return seconds;
  };
  secondsFor(100'000);
  const double one = secondsFor(1'000'000);
  const double four = secondsFor(4'000'000);
  EXPECT_LT(four, 12 * one + 0.05) << "four times the text must not take much more than four times as long";
}

TEST(ReadDescription, FlagsWhatContradictsItselfAndKeepsBoth) {
  const Result<Reading> reading = readDescription("Leaves opposite, ovate, 3-5 cm long. Leaves alternate, 12-15 cm long.");
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->traits.size(), 5u);
  ASSERT_EQ(reading->contradictions.size(), 2u);
  EXPECT_EQ(reading->contradictions[0].what, "leaf arrangement: \"opposite\" against \"alternate\"");
  EXPECT_EQ(reading->contradictions[1].what, "leaf length: \"3-5 cm long\" against \"12-15 cm long\"");
}

TEST(ReadDescription, AlternativesExceptionsAndKindsContradictNothing) {
  for (const char* text : {"Leaves opposite or alternate.", "Leaves opposite, rarely alternate.", "Leaves opposite, decussate.", "Lower leaves opposite; upper leaves alternate.", "葉對生或輪生。",
                           "Perennial evergreen herb.", "Leaves 3-5 cm long; leaves 4-6 cm long."}) {
    const Result<Reading> reading = readDescription(text);
    ASSERT_TRUE(reading);
    EXPECT_TRUE(reading->contradictions.empty()) << text;
  }
}

TEST(ReadDescription, ADeniedStatementContradictsItsAssertion) {
  const Result<Reading> reading = readDescription("葉對生，卵形。葉非對生。");
  ASSERT_TRUE(reading);
  ASSERT_EQ(reading->contradictions.size(), 1u);
  EXPECT_EQ(reading->contradictions[0].what, "leaf arrangement: \"對生\" against \"not 對生\"");
}

TEST(ReadDescription, ListsTermsThatItDoesNotUnderstand) {
  const Result<Reading> reading = readDescription("Leaves ovate, farinulent, glabrous; petals white, quincuncial.");
  ASSERT_TRUE(reading);
  ASSERT_EQ(reading->unknown.size(), 2u);
  EXPECT_EQ(reading->unknown[0].text, "farinulent");
  EXPECT_EQ(reading->unknown[0].organ, "leaf");
  EXPECT_EQ(reading->unknown[1].organ, "petal");
  const Result<Reading> chinese = readDescription("葉卵形，瓢囊狀，無毛。");
  ASSERT_TRUE(chinese);
  ASSERT_EQ(chinese->unknown.size(), 1u);
  EXPECT_EQ(chinese->unknown[0].text, "瓢囊狀");
}

TEST(DecodeDescription, KnowsGb18030AndFilesOfSeveralEncodings) {
  const std::string gb = "\xD2\xB6\xB6\xD4\xC9\xFA\xA3\xAC\xC2\xD1\xD0\xCE\xA1\xA3";  // 叶对生，卵形。
  const auto text = decodeDescription(gb);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(text->encoding, "GB18030");
  EXPECT_EQ(traitsOf(gb), (Lines{"leaf arrangement opposite", "leaf shape ovate"}));
  const std::string mixed = gb + "\n\xB8\xAD\xB9\xEF\xA5\xCD\n" + "\u82b1\u767d\u8272\u3002";  // and Big5, and UTF-8
  const auto several = decodeDescription(mixed);
  ASSERT_TRUE(several) << several.error().message;
  EXPECT_EQ(several->encoding, "Big5 and GB18030 and UTF-8");
  EXPECT_EQ(several->utf8, "叶对生，卵形。\n葉對生\n花白色。");
}

TEST(DecodeDescription, SaysWhichEncodingItMet) {
  const auto text = decodeDescription("\xB8\xAD\xB9\xEF\xA5\xCD");  // 葉對生 in Big5
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(text->encoding, "Big5");
  EXPECT_EQ(traitsOf(text->utf8), (Lines{"leaf arrangement opposite"}));
}

// As the bytes of a file come: some at a time.
NextBytes inBites(const std::string& text, std::size_t most) {
  return [&text, most, at = std::size_t{0}]() mutable {
    const std::string bytes = text.substr(std::min(at, text.size()), most);
    at += bytes.size();
    return bytes;
  };
}

TEST(ReadInPieces, SaysWhatTheWholeSaysWithPlacesInTheWhole) {
  const std::string paragraph = "Leaves opposite, ovate, 3-8 cm long; petals 5.\n\n葉互生，披針形，長3-8公分，鋸齒緣，farinulent。\n\n";
  std::string text;
  for (int k = 0; k < 90; ++k) text += paragraph + std::string(100'000, '\n');
  std::size_t traits = 0;
  std::size_t inOrder = 0;
  const auto pieces = readInPieces(inBites(text, 700'001), [&](const Reading& reading) {
    traits += reading.traits.size();
    std::size_t last = 0;
    for (const Trait& trait : reading.traits) {
      inOrder += trait.start >= last && text.substr(trait.span.begin, trait.span.end - trait.span.begin) == trait.text ? 1 : 0;
      last = trait.start;
    }
  });
  ASSERT_TRUE(pieces) << pieces.error().message;
  EXPECT_GE(*pieces, 2u);
  EXPECT_EQ(traits, 90 * readTraits(paragraph)->size());
  EXPECT_EQ(inOrder, traits);
}

TEST(ReadInPieces, CutsAnEndlessLineBetweenCharacters) {
  std::string text = "葉";
  while (text.size() < 4'500'000) text += "                              葉";
  const auto pieces = readInPieces(inBites(text, 1'000'000), [](const Reading&) {});
  ASSERT_TRUE(pieces) << pieces.error().message;
  EXPECT_EQ(*pieces, 2u);
}

TEST(ReadInPieces, RefusesNothingAndWhatIsNoText) {
  for (const std::string& text : {std::string(), std::string(9'000'000, '\n'), std::string(9'000'000, '\1')}) {
    const auto pieces = readInPieces(inBites(text, 1'000'000), [](const Reading&) { ADD_FAILURE() << "nothing was to be read"; });
    ASSERT_FALSE(pieces);
    EXPECT_EQ(pieces.error().code, ErrorCode::BadInput);
  }
}

}  // namespace
}  // namespace axil::keywords
