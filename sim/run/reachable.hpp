// What the rig can follow: how fast a load can be moved at each contraction ratio, how far, and by how much
// the muscle's pressure lags behind the current. Computed from the plant, quasi-statically.
#pragma once

#include <controllers/reach.hpp>
#include <plant/rig.hpp>

namespace mckibben::run {

/// Tables over contraction ratio and over loads, from 1 kg to the heaviest that the span pressure lifts.
///
/// The air that a movement needs, R T q = P' V + p V' e' (valve volume included), is what valve and hose in
/// series give at the pressure that carries the load against friction and guide in that direction. Left out:
/// inertia, the time to cross the band in which friction holds the load after a turn, and load offset and
/// effects but the rubber tube, of which nobody who asks for this knows.
controllers::Reach reachable(const plant::Rig& rig);

/// The ends alone, with the rig's effects: speeds and lags are empty.
controllers::ReachOfLoad ends_of_way(const plant::Rig& rig, double load_kg);

}  // namespace mckibben::run
