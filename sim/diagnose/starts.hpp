// Where a fit of wide numbers begins: one whose value is hardly known may lie beyond a ridge that no descent
// from what is written crosses. So the range is looked over at a few places first (Halton, Numer. Math. 2
// (1960) 84-90), and the best of them are begun from as well.
#pragma once

#include <vector>

#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// The model at the best places of its wide numbers, best first; none if it has no wide ones. Scored on a few
/// of the training runs. Throws run::Interrupted.
std::vector<Model> places_to_begin(const Case& c, const Model& described);

/// The model where one of its numbers is far off and all others are as described: the best such place.
std::vector<Model> one_number_far_off(const Case& c, const Model& described);

/// The model with its nominal numbers as they are in another rig.
Model begun_at(Model model, const Rig& other);

/// The model with one of its effects in each of the shapes that it is looked for in: a shape that was found
/// while something else was missing may be far off. At the numbers of these rigs, and at its own.
std::vector<Model> in_other_shapes(const Model& model, std::vector<const Rig*> rigs);

/// What fits best may have ended beside the deepest valley: if much is left with it, or a number is bent, it
/// is begun from the numbers of these rigs too, with one of its effects in another shape, and from the
/// numbers of the first with one far off. The deepest end is kept, of those that are as good on the runs held
/// out.
void deepen(const Case& c, Contender& end, const std::vector<const Rig*>& others, const Step& step);

/// The same of the trial that fits best.
void deepen_best(const Case& c, std::vector<Trial>& trials, const std::vector<const Rig*>& others,
                 const Step& step);

/// A rival that moves the readings as what meets them does, and is left far behind all the same, may have
/// ended beside the valley: it is begun from the numbers of the one that arrived, too.
void catch_up(const Case& c, std::vector<Trial>& trials, const Step& step);

/// Whether fits from several places ended in valleys of different depth. `costs`: where each ended.
bool disagree(const std::vector<double>& costs);

}  // namespace mckibben::diagnose
