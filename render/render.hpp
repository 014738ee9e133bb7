#pragma once
/// \file
/// Render: a grown plant becomes something to look at. The room takes a simeco::Plant and nothing else; it does not know
/// which grammar grew it or which photos it was measured on.
///
/// A plant is first made a PlantMesh: stems as smooth tubes, leaves, flowers and fruits as placed copies of small models,
/// every triangle with the organ it belongs to. From that come pictures (soft light, no display needed), animations of
/// growth, and mesh files. And since a grown plant has stems and nodes like a measured one, it can be written as a skeleton.
///
/// Everything is deterministic: the same plant and options give the same bytes. VTK, OpenGL, OpenCV and tinygltf are used
/// inside and appear in no header.

#include "render/gallery.hpp"     // contact sheets of shapes
#include "render/types.hpp"           // PlantMesh, Material, Image: the nouns
#include "render/plant_mesh.hpp"      // simeco::Plant -> PlantMesh
#include "render/highlight.hpp"       // some organs in another colour
#include "render/picture.hpp"         // PlantMesh -> Image, PNG
#include "render/animation.hpp"       // growth -> folder of PNGs, mp4, webm
#include "render/mesh_files.hpp"      // PlantMesh -> glb, obj, ply
#include "render/plant_skeleton.hpp"  // simeco::Plant -> skeleton3d::Skeleton
