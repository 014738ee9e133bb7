#pragma once
/// \file
/// The measuring room: photos, cameras and clicks come in, a Skeleton goes out. It knows nothing of grammars.
///
/// A person photographs a plant from several sides (front, right and top by name) and clicks the same points of it, the
/// nodes, in two or more of the photos; stems are chains of nodes. Each click is a ray of the plant's space; a node is where
/// its rays meet best, measured in pixels. Every node carries how sure it is (sigma) and how far each click is from where
/// the node projects to. What goes out is one tree, checked; whatever is wrong with it is said in one go, node by node.
///
/// Cameras are either known (orthographic or perspective, with lens distortion) or estimated first, from nominal directions,
/// a clicked origin, a known length and the clicks themselves.
///
/// Units: photos in pixels, space in the project's unit. Everything is a plain value and a free function; the answer does
/// not depend on the order of views, nodes or stems, nor on the number of threads.
/// Source: L-Grammar Generator 2005, section 3.2; docs/measuring.md says how to photograph and what is reported.

#include "skeleton3d/types.hpp"     // Camera, View, ClickedNode, Skeleton
#include "skeleton3d/camera.hpp"    // plant points to pixels and back
#include "skeleton3d/photo.hpp"     // photo files, upright
#include "skeleton3d/uncertainty.hpp"  // covariance of nodes, lengths, angles
#include "skeleton3d/known_length.hpp"  // the ends of a rod, as its photo shows them
#include "skeleton3d/estimate.hpp"  // cameras nobody calibrated
#include "skeleton3d/calibrate.hpp"  // a lens from photos of a chessboard
#include "skeleton3d/guides.hpp"    // where a click of one view can be in another
#include "skeleton3d/live_wire.hpp"  // the way along a stem while the mouse moves
#include "skeleton3d/stem_between.hpp"  // the same stem in another view
#include "skeleton3d/guide_candidates.hpp"  // where in another photo a click can be, ranked
#include "skeleton3d/snap.hpp"      // a click onto its stem's centre line
#include "skeleton3d/snap_place.hpp"  // snapped clicks to nodes and radii
#include "skeleton3d/photographed.hpp"  // cameras and nodes by clicks and photos together
#include "skeleton3d/width.hpp"     // widths to radii, tapers
#include "skeleton3d/draft.hpp"     // masks to a draft of all stems
#include "skeleton3d/solve.hpp"     // clicks to nodes
#include "skeleton3d/doubts.hpp"    // clicks and segments to look at again
#include "skeleton3d/tree.hpp"      // nodes and stems to one checked tree
#include "skeleton3d/report.hpp"    // what a person wants to see of it
