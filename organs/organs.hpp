#pragma once
/// \file
/// Organs: small meshes of leaves, flowers and fruits, from a name or a few numbers, at a chosen level of detail. The room
/// knows neither plants nor text: keywords finds a shape's name in a description, render scales and turns the mesh and puts
/// it where a grammar says. Every mesh is a plain value and depends on nothing but its arguments.

#include "organs/types.hpp"   // Mesh, Part, Detail
#include "organs/leaf.hpp"    // leaf shapes, flat outlines, curved blades
#include "organs/compound.hpp"  // leaves of several leaflets
#include "organs/flower.hpp"  // flowers from whorls of such blades
#include "organs/fruit.hpp"   // fruits
#include "organs/model.hpp"   // any of them by the name in a grammar
