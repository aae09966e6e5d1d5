// The numbers that decide. What says only how far a search goes stands where the search is.
#pragma once

namespace mckibben::identify {

struct Decisive {
  double tails =
      4.0;  ///< degrees of freedom of Student's t, of sizes and parameters; a convention for heavy tails
  double errors = 2.0;  ///< standard errors of a paired held-out difference (Vehtari, Gelman, Gabry 2017)
  double strong = 3.0;  ///< nats: strong evidence is above log 20 (Kass & Raftery 1995)
  double bent = 0.95;   ///< of chi^2: parameters further off may imitate what is missing; convention
  double conflict =
      4.6;             ///< deviations: one in a hundred of the prior is further off (Evans & Moshonov 2006)
  double mass = 0.05;  ///< of the posterior mass: rivals that are shown; convention
  int most_together =
      4;  ///< effects and bench faults in one set; all numbers of them alike (Scott & Berger 2010)
  double wander_s = 2.0;                             ///< that the input's wander stays alike
  double wander_knot_s = 1.0;                        ///< between knots of it
  double error_length_s = 1.0;                       ///< of the model error: log-normal round it,
  double error_length_sd = 1.5;                      ///< of its logarithm
  double terms_N[3] = {1.0, 5.0, 25.0};              ///< scales of general terms
  double few_N[5] = {1.0, 5.0, 25.0, 125.0, 625.0};  ///< of a few of them: F e^3 counts in hundreds
  double stretch_sd = 0.3;  ///< of the logarithm of a wave's wavelength, round its family's, whose
                            ///< neighbours are 0.7 to 0.07 apart; convention
  double least = 0.05;      ///< of an effect's typical size: as good as absent, and may be stiff
};
inline constexpr Decisive decisive;

}  // namespace mckibben::identify
