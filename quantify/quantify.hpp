#pragma once
/// \file
/// quantify: a measured skeleton becomes numbers that a grammar can carry.
///
/// A description names how leaves stand and a user says where: `withLeaves` gives them places on the skeleton. `measure`
/// then walks the tree as the thesis does: the length of each segment, its level from the root, its parent and children,
/// whether it goes on as the main stem or branches off, and the two angles rotr and rotu by which it leaves its parent. The
/// same turning rule (base/turning.hpp) grows the plant again, so the numbers lose nothing. `segmentsCsv` hands them to other
/// programs, `templatesOf` and `orderStatistics` say what is alike in them, for the grammars that predict and summarise.
/// Source: L-Grammar Generator 2005, sections 3.2.3 and 3.3.

#include "quantify/types.hpp"       // Segment, LeafMeasure, Measurements, LeafArrangement
#include "quantify/leaves.hpp"      // arrangements become leaves
#include "quantify/stalks.hpp"      // stalks that a grown plant has as stems
#include "quantify/measure.hpp"     // a skeleton becomes numbers
#include "quantify/csv.hpp"         // numbers as a table
#include "quantify/statistics.hpp"  // ranges, templates, branching orders
#include "quantify/structure.hpp"   // axes, orders, ranks, nodes, internodes, monopodial or sympodial
#include "quantify/circular.hpp"    // means of angles around a stem
#include "quantify/phyllotaxis.hpp" // divergence and the preset that fits it
#include "quantify/branching.hpp"   // where along an axis branches stand
#include "quantify/subtrees.hpp"    // what repeats, exactly and nearly
#include "quantify/schedule.hpp"    // when each part was made, and what still grows
#include "quantify/fates.hpp"       // what becomes of an apex, by the rank of its node
#include "quantify/arms.hpp"        // axes that leave a node together and differ
#include "quantify/layers.hpp"      // statistics by order and rank, of one plant or many
#include "quantify/bow.hpp"         // laws by which lengths rise to a level, fall to one or leave it
#include "quantify/outlook.hpp"     // what the next stages will be like
#include "quantify/distribution.hpp" // a number, normal, even, or a table
#include "quantify/family.hpp"      // the process that plants look like samples of
#include "quantify/backtest.hpp"    // how well that foretells what is known
#include "quantify/compare.hpp"     // how near two plants, or two sets of plants, are
