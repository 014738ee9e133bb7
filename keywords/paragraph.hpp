#pragma once
/// \file
/// Private to the room: one paragraph, read in one walk over its tokens. The reader keeps in mind which organ, which piece of it
/// and which place on it is being spoken of (scope.cpp), reads terms (terms.cpp), counts (counts.cpp) and sizes (sizes.cpp),
/// and weighs whether the paragraph is about a plant at all (evidence.cpp).

#include "keywords/lexicon.hpp"
#include "keywords/quantities.hpp"
#include "keywords/tokens.hpp"
#include "keywords/types.hpp"
#include "keywords/words.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace axil::keywords {

/// What is being spoken of.
struct Scope {
  const Concept* organ = nullptr;
  const Concept* partner = nullptr;  ///< "sepals and petals 5": the organ named together with it
  const Concept* piece = nullptr;    ///< lobe, tube, blade
  const Concept* place = nullptr;    ///< apex, base, margin, surface
  std::string which;                 ///< "basal"
  std::size_t organEnd = 0;          ///< token after the last organ, piece or place named
  bool organInSentence = false;
  bool subjectInClause = false;   ///< since the last . or ;
  bool subjectInSegment = false;  ///< since the last comma too
  bool commaSincePlace = false;
  const Concept* container = nullptr;  ///< "racemes of 5-12 flowers": the racemes, when the flowers were named last
  const Concept* member = nullptr;     ///< 花組成繖房花序: the flowers, when the inflorescence was named last
  const Concept* host = nullptr;       ///< "blade with glands near base, margin serrate": the blade, when the glands were named last
  bool whichInSegment = false;         ///< 中部膨大，長5公分: `which` holds until the comma
  bool stranger = false;  ///< a part that the vocabulary does not have is spoken of: "connectives 2-4 mm"
};

/// A statement that was denied, for finding contradictions.
struct Denial {
  Trait trait;
};

struct ParagraphResult {
  std::vector<Trait> traits;
  std::vector<Denial> denials;
  std::vector<UnknownTerm> unknown;
};

class ParagraphReader {
 public:
  /// `text` begins at byte `firstByte` of the description; `organBefore` is what the text before it, cut off, was about.
  ParagraphReader(std::string_view text, std::uint32_t firstByte, const TokenList& list, const Concept* organBefore);

  /// All that the paragraph says; nothing when it is not about a plant.
  ParagraphResult read();
  /// After read(): much of the paragraph is not vocabulary, so that single characters may be parts of other words.
  [[nodiscard]] bool isUnsure() const { return unsure_; }
  [[nodiscard]] const Concept* organ() const { return scope_.organ; }

 private:
  struct LastTerm {
    std::size_t end = 0;
    const Category* category = nullptr;
    std::string qualifier;
    bool negated = false;
    bool kept = false;
    bool linked = false;  // it stands with its organ
  };
  struct Measure {
    std::size_t end = 0;
    std::string unit;
  };
  /// What a number with a word counts: "5-lobed", 5裂, "6-seeded".
  struct Counted {
    std::string organ;  ///< empty: the organ in scope
    std::string piece;
    std::string unit;
    std::size_t end = 0;
  };

  [[nodiscard]] bool is(std::size_t i, std::string_view text) const { return i < tokens_.size() && tokens_[i].text == text; }
  [[nodiscard]] bool isAny(std::size_t i, Words words) const { return i < tokens_.size() && isOneOf(tokens_[i].text, words); }
  [[nodiscard]] bool isHan(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::Han; }
  [[nodiscard]] bool isCapital(std::size_t i) const;
  [[nodiscard]] bool isSentenceEnd(std::size_t i) const;
  std::size_t step(std::size_t i);
  /// Whether only a few words that name no organ stand between the begin of the sentence and token i.
  [[nodiscard]] bool opensSentence(std::size_t i) const;
  [[nodiscard]] bool startsSentence(std::size_t i) const;

  // scope.cpp
  [[nodiscard]] const Concept* nounAt(std::size_t i, std::string_view role = {}) const;
  [[nodiscard]] bool isVerbLeaves(std::size_t i) const;
  [[nodiscard]] bool isSwitchedOff(std::size_t i) const;
  [[nodiscard]] bool opensDescription(std::size_t i) const;
  [[nodiscard]] bool isBranchNoun(std::size_t i) const;
  [[nodiscard]] bool isPlantNoun(std::size_t i) const;
  [[nodiscard]] bool isFlowerSpokenOf() const;
  [[nodiscard]] bool isLocative(std::size_t i) const;
  [[nodiscard]] bool isPlaceOnly(std::size_t i) const;
  [[nodiscard]] bool isGoal(std::size_t i) const;
  [[nodiscard]] bool isOfPlaceBefore(std::size_t i) const;
  [[nodiscard]] bool looksAdjectival(std::size_t i) const;
  [[nodiscard]] bool isPlaceOfTermBefore(std::size_t i) const;
  [[nodiscard]] bool startsALine(std::size_t i) const;
  [[nodiscard]] bool isChained(std::size_t i) const;
  [[nodiscard]] bool isRightBehindOrgan(std::size_t i) const;
  [[nodiscard]] const Concept* ownerOf(const Concept& piece, std::size_t i) const;
  [[nodiscard]] std::string whichBefore(std::size_t i) const;
  void noteSign(std::size_t i);
  void noteBracket(std::size_t i);
  [[nodiscard]] bool isStranger(std::size_t i, std::size_t end) const;
  void noteStranger(std::size_t i);
  void noteScar(std::size_t i);
  [[nodiscard]] const Concept& stalkOf(const Concept& stalk) const;
  [[nodiscard]] const Concept& stipeOf(const Concept& stipe) const;
  [[nodiscard]] std::size_t afterExcept(std::size_t i) const;
  [[nodiscard]] bool beginsComparison(std::size_t i) const;
  [[nodiscard]] std::size_t afterComparison(std::size_t i) const;
  [[nodiscard]] const Concept* bladeOwner(std::size_t i) const;
  void noteNoun(std::size_t i);
  [[nodiscard]] bool isNamedAgain(std::size_t i, const Concept& organ) const;
  void noteOrgan(std::size_t i, const Concept& organ);
  void notePiece(std::size_t i, const Concept& piece);
  void notePlace(std::size_t i, const Concept& place);
  void noteWhich(std::size_t i);
  void enterLeaf(std::size_t end);

  // terms.cpp
  [[nodiscard]] bool hasTraitMeaning(std::size_t i) const;
  [[nodiscard]] const Concept* placeAfter(std::size_t end) const;
  /// The organ that an adjective stands before, and which piece of it.
  struct Ahead {
    const Concept* organ = nullptr;
    const Concept* piece = nullptr;
  };
  [[nodiscard]] Ahead nounAhead(std::size_t end) const;
  [[nodiscard]] const Concept* organAfter(std::size_t end) const;
  [[nodiscard]] bool isOfAnotherOrgan(const Category& category, const Concept* organ, bool named) const;
  [[nodiscard]] bool isAboutHairs(std::size_t end) const;
  [[nodiscard]] bool isBeforeStrangeNoun(std::size_t end) const;
  [[nodiscard]] bool isPredicateBasal(std::size_t i) const;
  [[nodiscard]] bool isAboutTheUnnamed(std::size_t i) const;
  [[nodiscard]] bool speaksAsTerm(std::size_t i) const;
  [[nodiscard]] bool saysNothingOf(const Meaning& meaning, std::size_t i, const Concept* organ, const Concept* place) const;
  [[nodiscard]] std::optional<Meaning> deeperCut(std::size_t i, const Meaning& meaning) const;
  [[nodiscard]] bool accepts(const Category& category, const Concept* organ) const;
  [[nodiscard]] const Meaning* meaningFor(const Found& f, const Concept* organ, const Concept* place) const;
  [[nodiscard]] bool isNegated(std::size_t i) const;
  [[nodiscard]] std::string qualifierBefore(std::size_t i) const;
  [[nodiscard]] bool continuesCompound(std::size_t i, const Category& category) const;
  [[nodiscard]] bool goesElsewhere(std::size_t i, std::size_t end) const;
  [[nodiscard]] bool isOppositeOfLeaves(std::size_t i) const;
  void readTerm(std::size_t i);
  void startWithPlant(std::size_t i);
  void enterPlant(std::size_t end);
  /// Whose statement a term is.
  struct Subject {
    const Concept* organ = nullptr;
    const Concept* piece = nullptr;
    bool attributive = false;  ///< named behind the term
    const Concept* place = nullptr;
    bool placeNamed = false;
  };
  void keepTerm(std::size_t i, const Meaning& meaning, const Subject& subject, const LastTerm& now);
  void extendCompound(const Found& f, const std::string& value);
  [[nodiscard]] Trait traitAt(std::size_t first, std::size_t end, const std::string& organ, const std::string& property) const;
  void quote(Trait& trait, std::size_t first, std::size_t end) const;
  void keep(Trait trait, bool attributive);

  // elisions.cpp
  [[nodiscard]] std::size_t afterSharing(std::size_t end) const;
  void readElidedPinnate(std::size_t i, const LastTerm& now);
  void readElidedCut(std::size_t i, const LastTerm& now);
  bool readTernate(std::size_t i);
  std::size_t readInThrees(std::size_t i);
  [[nodiscard]] bool isMannerOfAnother(std::size_t i, std::string_view value) const;
  void countVeins(std::size_t i);

  // teeth.cpp
  struct Teeth {
    std::size_t first = 0;  ///< where their adjectives begin
    bool fine = false;
    bool blunt = false;
  };
  [[nodiscard]] Teeth teethAt(std::size_t i, std::size_t end) const;
  [[nodiscard]] std::optional<Meaning> finerTeeth(std::size_t i, const Meaning& meaning) const;
  bool readHanTeeth(std::size_t i, const Concept& owner);
  void readFewLobes(std::size_t i, const Concept& owner);
  bool readSpinesOfMargin(std::size_t i, const Concept& organ);
  void readElidedDouble(std::size_t i, const LastTerm& now);
  bool readTeeth(std::size_t i, const Concept& owner);

  // counts.cpp
  [[nodiscard]] bool isGathered(std::size_t i) const;
  [[nodiscard]] bool isGatheredAhead(std::size_t i) const;
  [[nodiscard]] std::size_t afterPerNode(std::size_t i) const;
  [[nodiscard]] bool leafIsMeant(std::size_t from, std::size_t to) const;
  [[nodiscard]] Measure measureAt(std::size_t i) const;
  [[nodiscard]] Counted countedBy(std::size_t i) const;
  [[nodiscard]] Counted teethBehindCounter(std::size_t i) const;
  [[nodiscard]] bool isWordWithNumber(std::size_t i) const;
  [[nodiscard]] std::size_t beforeCount(std::size_t i) const;
  std::size_t readCount(std::size_t i);
  std::size_t readLeavesPerNode(std::size_t i, const NumberRange& range);
  std::size_t readCountedWord(std::size_t i, const NumberRange& range);
  std::size_t readCountOfOrganBefore(std::size_t i, const NumberRange& range);
  std::size_t readCountOfOrganAfter(std::size_t i, const NumberRange& range);
  [[nodiscard]] std::size_t afterAdjectives(std::size_t from) const;
  std::size_t readCountGoingOn(std::size_t i, const NumberRange& range);
  std::size_t readNumerous(std::size_t i);
  std::size_t readAbsent(std::size_t i);
  [[nodiscard]] std::size_t afterUnread(std::size_t i, const NumberRange& range) const;
  std::size_t readDivisions(std::size_t i);
  [[nodiscard]] bool isBehindRows(std::size_t before) const;
  [[nodiscard]] std::size_t beforeEach(std::size_t i) const;
  [[nodiscard]] std::string unitOfEach(std::size_t i) const;
  void addLobedShape(std::size_t i, std::size_t end, const NumberRange& range);
  void addCount(std::size_t first, std::size_t end, const std::string& organ, const std::string& piece, const NumberRange& range, const std::string& unit);

  // sizes.cpp
  [[nodiscard]] bool isAltitude(std::size_t i) const;
  [[nodiscard]] bool isHeightOfPlant(const Size& size) const;
  [[nodiscard]] bool isExtent(std::size_t first) const;
  std::size_t readSizes(std::size_t i);
  [[nodiscard]] const Concept* measuredOrgan(const Size& size, const Concept* subject) const;
  std::size_t readAngle(std::size_t i);
  [[nodiscard]] const Concept* bladeNamedLast() const;
  [[nodiscard]] const Concept* dimensionOfOrganWord() const;

  // evidence.cpp
  void weighNoun(std::size_t i, const Concept& organ);
  void weighTerm(std::size_t i, const Meaning& meaning, bool linked);
  void weighForeign(const Found& f);
  [[nodiscard]] bool isHabitat(std::size_t i) const;
  struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
  };
  [[nodiscard]] std::vector<Stretch> tellingSentences() const;
  [[nodiscard]] Stretch tellingClauses() const;
  [[nodiscard]] bool isTold(const std::vector<Stretch>& stretches) const;
  [[nodiscard]] bool isUse(std::size_t i) const;
  [[nodiscard]] bool beginsStrangely(std::size_t first, std::size_t end) const;
  [[nodiscard]] double strangeShare(const std::vector<Stretch>& stretches) const;
  [[nodiscard]] bool isAboutStrangeThings(const std::vector<Stretch>& stretches) const;
  [[nodiscard]] bool isAboutAPlant() const;
  [[nodiscard]] bool isNothingButTerms() const;
  [[nodiscard]] bool isKnown(std::size_t i) const;
  [[nodiscard]] std::vector<bool> tokensOfTraits() const;
  [[nodiscard]] double knownShare() const;
  [[nodiscard]] double knownShare(const std::vector<Stretch>& stretches) const;
  void findUnknown();
  void noteUnknownSegment(std::size_t first, std::size_t end);

  std::string_view text_;
  std::uint32_t firstByte_;
  const std::vector<Token>& tokens_;
  std::vector<Found> found_;
  ParagraphResult result_;
  Scope scope_;
  std::vector<Scope> outside_;  // what was being spoken of where each open bracket began
  LastTerm last_;
  struct LastCount {
    std::size_t end = 0;
    std::string organ;
    std::string piece;
    std::string unit;
  };
  LastCount lastCount_;
  std::size_t sizeEnd_ = 0;        // where the last size ended, and
  std::string sizeQualifier_;      // how it was meant
  std::size_t placeOnlyEnd_ = 0;   // where the last organ ended that was only named to place or compare another
  bool plantInSentence_ = false;
  std::size_t sentenceBegin_ = 0;
  bool plantSeen_ = false;  // a life form, a duration of the whole
  std::map<const Concept*, std::size_t> namedAt_;      // where each organ was named last
  std::map<const Concept*, std::size_t> subjectAt_;    // and where not only to place or compare another
  std::vector<std::pair<std::size_t, std::string>> organFrom_;  // which organ was spoken of from which token on, for unknown words
  double evidence_ = 0;
  bool bareTerms_ = false;  // "opposite", "simple, entire": nothing but a few terms
  bool pronounSeen_ = false;
  bool plantNamed_ = false;  // by a word that is not part of another
  bool unsure_ = false;
  bool organSeen_ = false;   // an organ that only plants have
  bool bodySeen_ = false;    // a stem, a branch
  int strongTerms_ = 0;      // different words that only botany uses
  bool strongSeen_ = false;  // a word that only botany uses
  std::set<const Concept*> organsWeighed_;
  std::set<const Concept*> termsWeighed_;
  std::set<std::string> foreignSeen_;
};

[[nodiscard]] const Concept& organNamed(std::string_view name);
/// Whether a bare number beside that organ counts it.
[[nodiscard]] bool isCountable(const Concept& noun);

}  // namespace axil::keywords
