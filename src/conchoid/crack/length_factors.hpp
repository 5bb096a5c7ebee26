#pragma once

#include <array>
#include <cstddef>
#include <numbers>

/// Every length, angle and count by which cracks are measured, moved and joined, with its unit and the reason
/// for its value. No length of the crack room is in metres: × r̄ is the edge of the coarse front (resolution),
/// × h the spacing of the markers of a fine front, × ē the mean edge of the front at hand. Cosines are between
/// unit vectors; "equal" tolerances are relative and above round-off only, so that a mirrored or turned crack
/// takes the same decisions.
namespace conchoid {

// Stress intensities: which openings behind a front are fitted (intensity/).

/// × ē, along the front from its node: two edges to either side give five feet, enough for A, A' and A".
inline constexpr double kFitReachAlong = 1.6;
/// × ē, behind the front: three rows, the least that tell B from the deviation of the elements.
inline constexpr double kFitReachBehind = 3.6;
/// × ē: nearer rows, as a slow front leaves behind, count as (r/0.4)²: their openings are mostly error.
inline constexpr double kFitFullWeight = 0.4;
/// Rows of nodes searched: thin strips take several to get beyond kFitFullWeight.
inline constexpr int kFitRows = 6;
/// Of the weights, on A', A" and B: keeps them 0 where the samples cannot tell them; A" most, as K varies
/// slowly along a front.
inline constexpr std::array<double, 3> kFitRidge{2e-3, 1e-2, 1e-4};
/// Of the weights, on B of a Galerkin solution: on a crack of three rows it would follow the deviation of the
/// elements, not the field.
inline constexpr double kFitRidgeGalerkin = 1e-2;
/// × distance of the first row: the piecewise linear Galerkin opening is, from the second row on, the exact one
/// of a front this far behind the true one; the same on every mesh (docs/verification.md, 54 … 1536 triangles).
inline constexpr double kFrontShift = 0.10;
/// × exact opening: the first row of that solution, where the mesh is regular.
inline constexpr double kFirstRowExcess = 1.022;
/// Weight of the first row against the others, where it is to say how much opens: it scatters with the pattern of the
/// mesh …
inline constexpr double kFirstRowWeight = 0.02;
/// × opening: … by less than this; what is farther off says nothing of the direction either.
inline constexpr double kFirstRowScatter = 0.35;

/// Change of K from node to node over its size: below it K is smooth, as on any front away from a ligament …
inline constexpr double kResolvedChange = 0.75;
/// … and above it noise: an angle of 77° between the two.
inline constexpr double kUnresolvedChange = 1.25;
/// Passes of (1, 2, 1)/4 over K that is not resolved: a change of sign from node to node is gone after the first.
inline constexpr int kIntensityPasses = 2;
/// × the largest K along a front: what is less lies within a few times the error of the elements (docs/verification.md).
inline constexpr double kTellingShare = 0.05;
/// × the law's step, where K is reversed from node to node: the next frame may know better.
inline constexpr double kLeastUnresolvedStep = 0.25;
/// Of θ⁴, θ³, θ³ and θ² in what a kink θ does to the opening at it: fitted to kinked cracks in the plane of 8 … 70°
/// and 1 … 3 r̄ long, against displacement discontinuities of r̄/20 (docs/verification.md).
inline constexpr std::array<double, 4> kKinkRates{0.071, 0.21, 0.10, 0.31};
/// Of the weights of all samples, that those not behind a kink must have: less is a strip too thin to read from,
/// and the rows behind it say more.
inline constexpr double kLeastShareAhead = 2e-3;

// Law and initiation (law/).

/// × c_R: slowest motion of a point that moves at all, or nearly arrested fronts would take frames without end.
inline constexpr double kLeastSpeedFraction = 0.1;
/// × r̄: length over which a change of toughness deflects the crack; of a wave of wavelength r̄ it gives the
/// amplitude.
inline constexpr double kDeflectionLength = 0.5 / std::numbers::pi;
/// Relative: severities within it are equal, as the stress itself is no better.
inline constexpr double kEqualSeverity = 1e-3;
/// Relative: distances from the centre that are equal but for round-off.
inline constexpr double kEqualRemoteness = 1e-6;
/// Cosine below which a reference direction is perpendicular and fixes no sign.
inline constexpr double kPerpendicularCosine = 1e-6;
/// × radius of a new disc, its centre outside of the surface: none of its nodes lies in the surface itself.
inline constexpr double kDiscOutside = 0.1;
/// × radius, beneath a crack's face: a branch's disc is whole, but runs into the face with its first advance.
inline constexpr double kBranchDepth = 1.15;
/// × radius, from a branch's centre to all crack nodes: less than kBranchDepth, the face itself is allowed.
inline constexpr double kBranchClearance = 0.95;
/// Rings of triangles of a new disc: the least that have a node inside to read K at.
inline constexpr int kDiscRings = 2;

// The coarse front and its strips (front/).

/// × r̄: longer edges of a new front are divided; their halves are far above kCollapseBelow.
inline constexpr double kSplitAbove = 1.4;
/// × r̄: shorter edges are merged before they make slivers.
inline constexpr double kCollapseBelow = 0.2;
/// × r̄: a shrinking ring within this radius closes; its next step would carry it through its own centre.
inline constexpr double kClosingRadius = 0.3;
/// Share of the smoothing along a front that acts across it: enough against zigzag, too little to slow it down.
inline constexpr double kSmoothingAcross = 0.2;
/// Relative: distances to candidates for a correlation node that are equal.
inline constexpr double kEqualDistance = 1e-6;
/// Cosine between mean normals below which two cracks stand across each other and neither is turned.
inline constexpr double kAcrossSheets = 0.1;
/// rad: a crack's normal that turns more from row to row is kinked, not curved: it is not carried on to the front, and
/// openings behind it say nothing of the front. Up to twice that a share.
inline constexpr double kSmoothSurfaceTurn = 0.15;
/// Relative: diagonals of a strip's quadrilateral that are equally long.
inline constexpr double kEqualDiagonals = 1e-6;
/// 2 area / (longest edge)²: flatter triangles of a strip are degenerate.
inline constexpr double kLeastStripShape = 1e-3;
/// Cosine between a strip triangle's normal and displacement × tangent: below it the triangle is turned over.
inline constexpr double kLeastStripCosine = 0.02;
/// Times that the displacement of a node with a spoiled triangle is halved before it stays.
inline constexpr std::size_t kStripHalvings = 4;

// The fine front (fine/).

/// × h: spacing of the markers; merged below, divided above: a divided edge is not merged again at once.
inline constexpr double kShortestSpacing = 0.5;
inline constexpr double kLongestSpacing = 1.5;
/// × h, from its last row: there a marker leaves the next one; less would leave slivers.
inline constexpr double kRowDistance = 0.5;
/// × h: the same at the end of a run, when nothing comes after.
inline constexpr double kLastRowDistance = 0.1;
/// × h: before its own crack's face, or behind another's, a marker stops; beyond it, so that the two cut the
/// body together.
inline constexpr double kFaceDistance = 0.5;
/// Sine of the angle to a face: a path below it runs along the face, not into it.
inline constexpr double kGrazingSine = 0.2;
/// Markers on either side whose rows are not in a marker's way: its own neighbours left them.
inline constexpr std::size_t kOwnMarkers = 4;
/// Parts of a sub-step, where h is finer than it: a marker makes no more than about h at a time.
inline constexpr int kSubStepParts = 4;
/// Divisions of an edge of the initial triangles: bounds what a coarse input can cost.
inline constexpr int kInitialDivisions = 64;
/// Relative: r̄/h = 20 + round-off is 20, and a face just reached is reached.
inline constexpr double kRoundOff = 1e-6;
/// Share of the way to the middle of its neighbours that an attached node slides in a frame: evens the coarse
/// edges out over a few.
inline constexpr double kSlide = 0.25;
/// … where its two edges differ by more than this share of their sum; less is harmless.
inline constexpr double kSlideFrom = 0.2;
/// × coarse edge: a marker from the coarse node attached to it; farther off it belongs to the next one.
inline constexpr double kMarkerOffset = 0.5;
/// × the arc: markers equally near to a place on it.
inline constexpr double kEqualArc = 1e-6;
/// Passes of (1, 2, 1)/4 over the deflections: a zigzag from marker to marker is gone after the first.
inline constexpr int kDeflectionPasses = 2;
/// 1/r̄: of K by the front's shape, that of a wave of wavelength r̄ (Rice 1985). docs/theory.md (S9)
inline constexpr double kShapeStiffness = std::numbers::pi;
/// × K_eff: bounds of what the shape does to it, as the first order holds for small waves only.
inline constexpr double kLeastShapeFactor = 0.25;
inline constexpr double kLargestShapeFactor = 4;
/// Fall per r̄ above the smoothed front, that brings a marker back to it. docs/theory.md (S8)
inline constexpr double kHeightFall = 1;

// Fronts that meet (closing/). What comes closer …

/// × r̄: … than this touches, whatever its orientation: the next frame would run through it.
inline constexpr double kTouchDistance = 0.3;
/// × r̄: … than this meets, where the sheets are oriented alike: the ligament is narrower than an element.
inline constexpr double kMeetDistance = 0.7;
/// × r̄: … than this meets within one front, where both sides are one crack already and nothing can pass.
inline constexpr double kMeetOneFront = 1.0;
/// × r̄, across the sheets: two fronts farther apart pass each other, as real ones do.
inline constexpr double kPassingOffset = 0.45;
/// Cosine between normals above which a touch counts as one of sheets oriented alike: any acute angle.
inline constexpr double kSameSide = 0;
/// Cosine between normals above which sheets are joined: bridges across steeper ones fold.
inline constexpr double kAlikeSheets = 0.5;
/// Edges along a front within which its parts are neighbours, not opposite each other.
inline constexpr std::size_t kNeighbourEdges = 3;
/// × r̄: widest ligament that breaks; about an element, what lies in it is not resolved.
inline constexpr double kWidestLigament = 1.4;
/// × r̄: widest ligament that breaks where its rims have kOverloadedRim × K_c: the next step of its two sides would take most of it.
inline constexpr double kWidestOverloadedLigament = 3;
inline constexpr double kOverloadedRim = 5;
/// × r̄: thinner ones break whatever K is said to be at their rims: no element fits in between.
inline constexpr double kThinnestLigament = 0.5;
/// × r̄: to which wider ones are narrowed first, well below kWidestLigament.
inline constexpr double kNarrowedLigament = 0.8;
/// Cosine between the ways of two parts of a front: below it they come together.
inline constexpr double kFacingWays = 0.5;
/// × the gap between them: what each may take, so that they do not cross.
inline constexpr double kShareOfGap = 0.4;
/// × r̄: with a smaller limit a node stays, or its strip would be slivers.
inline constexpr double kLeastStep = 0.05;
/// Opening [rad] of a front whose bottom waits for its sides to come together.
inline constexpr double kWaitingWedge = 120 * std::numbers::pi / 180;
/// Opening [rad] at which the two edges of a front are bridged: a triangle of good shape fits.
inline constexpr double kBridgedWedge = 75 * std::numbers::pi / 180;
/// Opening [rad] below which a last ligament at the surface breaks; a straighter front goes on by itself.
inline constexpr double kLastLigamentWedge = 135 * std::numbers::pi / 180;
/// × r̄: longest edge of a bridge: across kWidestLigament and an edge along it.
inline constexpr double kLongestBridgeEdge = 2.2;
/// × r̄: the same outside of the body, where its shape does not matter.
inline constexpr double kLongestBridgeOutside = 3.2;
/// × h: longest edge of a fine bridge, that of the markers' spacing.
inline constexpr double kLongestFineBridgeEdge = 1.5;
/// × (length of a stretch of coarse nodes + r̄): a longer row of markers goes round the rest of the front.
inline constexpr double kLongestStretch = 2;
/// Nodes inside the body between two outside that are a last ligament at most; more are a front.
inline constexpr std::size_t kLastLigamentNodes = 5;
/// Nodes between two stretches that are taken into the bridge; of more the front keeps a hole that grows shut.
inline constexpr std::size_t kPocketNodes = 6;
/// Cosine to the other side of an edge that runs away from it and is left out of the bridge.
inline constexpr double kRunningAway = -0.2;
/// Cosine of a bridge triangle's normal to those of its nodes, at which it folds.
inline constexpr double kFoldCosine = 0.05;
/// Badness of a fold: more than that of any number of slivers.
inline constexpr double kFoldBadness = 1e9;
/// Rounds in which long edges of a fine bridge are divided: a bound that is not reached.
inline constexpr int kDivisionRounds = 1000;
/// Relative: edges of a fine bridge that are equally long.
inline constexpr double kEqualLength = 1e-9;

// The last ligament (closing/last_ligament.hpp).

/// Cells per r̄: what is about to break is one r̄ wide, and a few cells tell its shape.
inline constexpr double kCellsPerEdge = 5;
/// Cells of the box around a body at most: bounds what a search costs.
inline constexpr double kMostCells = 4e6;
/// Cells on the smaller side of a cut at least; fewer are chips of the grid.
inline constexpr int kFewestCells = 30;
/// × r̄, from the cracks' ends: what is farther off is for the fronts to break.
inline constexpr double kLigamentBand = 3;
/// × face, for a crack's face that a cut leaves unused: an arm of a crack off the way costs little, and a cut
/// is only made where what it breaks is less than this share of the crack it completes.
inline constexpr double kUnusedFace = 0.3;
/// Cells by which it sticks out of the body.
inline constexpr int kCellsOutside = 2;
/// Cells within which it goes from one side of a crack to the other, at its rim.
inline constexpr double kCrossingCells = 1.5;
/// Passes in which nodes beside a crack slide along it: few, as they do not follow its curvature.
inline constexpr int kSlidingRounds = 5;
/// Passes over a ligament's surface: it is a few cells wide.
inline constexpr int kSmoothingRounds = 40;

}  // namespace conchoid
