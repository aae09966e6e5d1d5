// Which effects are missing: one is added after another, each chosen on runs that the fits have not seen.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/search.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// An effect that was taken, and one that explains the data as well; or, without the first, numbers of the
/// rig in place of the other.
struct Doubt {
  std::optional<EffectName> effect;
  EffectName rival;
  Fitted with_effect, with_rival;

  std::vector<std::string> words() const {
    return {effect ? effect->words() : "other numbers", rival.words()};
  }
};

/// A candidate as it is named.
inline NamedEffect named(const Candidate& candidate) {
  return {.name = candidate.effect, .variant = candidate.variant, .side = candidate.side};
}

struct Naming {
  Contender best{};
  std::vector<NamedEffect> effects{};    ///< names and what they may be confused with, by importance
  std::vector<Doubt> doubts{};           ///< in the same order
  std::vector<std::string> invisible{};  ///< effects of usual size that these data would not show
  std::vector<Ranked> ranking{};
  std::vector<std::string> confusion_names{};
  std::vector<std::vector<double>> confusion{};
};

enum class More { not_tried, tried_in_vain };
using AtFault = std::function<bool(const Contender&, More)>;

/// Starts from the nominal and from the recalibrated rig. `reference`: residuals held out that an improvement
/// is measured against. Where the search is ended, the best of what was tried by then is chosen. `at_fault`:
/// whether single runs are what is left beside a model, with one more effect not tried yet, or in vain. Then
/// no more names are looked for: they would stand in for the runs' faults.
Naming name_effects(const Case& c, const Contender& nominal, const Contender& recalibrated,
                    const Eigen::VectorXd& reference, const AtFault& at_fault, const Step& step,
                    Search& search);

}  // namespace mckibben::diagnose
