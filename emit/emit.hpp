#pragma once
/// \file
/// emit: measurements become a grammar.
///
/// `initialGrammar` writes one stage and one or two rules a segment, so that the grammar regrows exactly what was measured.
/// `predictiveGrammar` lets that plant grow one stage further, by what its own rules have in common. `structuredGrammar` says in a
/// few readable rules what plants of this kind look like. All three are Grammars, which simeco prints, derives and grows;
/// `inDialect` writes the initial one in other programs' languages. Nothing here reads a photo or grows a plant.
/// Source: L-Grammar Generator 2005, section 3.4.

#include "emit/initial.hpp"     // regrows the measured plant; EmitOptions
#include "emit/predictive.hpp"  // and one stage more
#include "emit/structured.hpp"  // plants like it, in few rules
#include "emit/described.hpp"   // from words alone
#include "emit/flowering.hpp"   // and the flowers of a measured plant that is described
#include "emit/dialects.hpp"    // cpfg, L-Py, MTG
