#pragma once
/// \file
/// Keywords: from the text of a botanical description to traits, each with the words it was read from, and from traits to the
/// numbers that measuring and drawing start with. English, Traditional and Simplified Chinese. Source: L-Grammar Generator
/// 2005, section 3.1.
///
///     const auto traits = readTraits("Leaves opposite, ovate, 3-8 cm long.");
///     const Presets presets = presetsOf(*traits);   // two leaves a node, turned by 90 degrees; "ovate"; 0.055 m
///
/// The room knows no photos and no grammars. Its words are data: data/*.tsv, listed for readers in docs/keywords.md.

#include "keywords/types.hpp"       // Trait, ArrangementPreset, Presets
#include "keywords/read.hpp"        // text to traits
#include "keywords/presets.hpp"     // traits to geometry
#include "keywords/report.hpp"      // for programs and for people
#include "keywords/vocabulary.hpp"  // the words themselves
