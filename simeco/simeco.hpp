#pragma once
/// \file
/// The grammar room: text becomes a Grammar, a Grammar becomes a string, a string becomes a plant. It knows nothing of
/// photos or pixels. The engine knows no syntax: SimEco text and classic L-system text both parse to one Grammar, which is
/// all that derivation and growth ever see.
///
/// docs/simeco.md and docs/lsystem.md are the languages' references.

#include "simeco/grammar.hpp"           // an L-system as a value
#include "simeco/language.hpp"          // SimEco text to Grammar and back, and what is wrong with it
#include "simeco/lsystem_language.hpp"  // the same for classic L-system text
#include "simeco/language_service.hpp" // what an editor asks about a text; its layout
#include "simeco/lsystem_text.hpp"      // a string as classic programs write it
#include "simeco/derive.hpp"            // a grammar's string, step by step
#include "simeco/plant.hpp"             // a plant at one moment: organs with frames, sizes, ages
#include "simeco/environment.hpp"       // what surrounds plants while they grow
#include "simeco/growth.hpp"            // a grammar grown over continuous time
#include "simeco/lsystem_view.hpp"      // what an L-system's turtle starts with
#include "simeco/lsystem_turtle.hpp"    // a string drawn into a sink
#include "simeco/lsystem_environment.hpp" // what answers the ?E of an L-system
#include "simeco/lsystem_derive.hpp"    // L-systems that ask where their turtle is
#include "simeco/lsystem_plant.hpp"     // an L-system as a plant
